// Draws the bodies of a scene into an Image, offscreen.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/frame/drawing_options.h"
#include "render/frame/drawn_body.h"
#include "render/image/picture.h"
#include "render/image/settings.h"
#include "sim/drawn/surface.h"

namespace billow::render {

/// A GL context with the run's meshes and textures in it. Not thread-safe: use it from the thread that made it.
class MeshRenderer {
 public:
  /// Throws InputError on an image size the GL cannot do, ResourceError when there is no such GL.
  MeshRenderer(const Settings& settings, std::vector<DrawnBody> bodies, const RunBounds& bounds,
               const DrawingOptions& options = {});
  ~MeshRenderer();
  MeshRenderer(const MeshRenderer&) = delete;
  MeshRenderer& operator=(const MeshRenderer&) = delete;

  /// One frame of one view, settings.width x settings.height. `bodies[b]` belongs to the b-th DrawnBody, whose place is
  /// as seen from a camera that moves at `camera_velocity` [m/s]. `time` [s] is what a camera with keys or a turntable
  /// goes by.
  Picture draw(View view, const std::vector<sim::SurfaceState>& bodies,
               const Eigen::Vector3d& camera_velocity = Eigen::Vector3d::Zero(), double time = 0.0);

  /// The v_max [m/s] in use.
  double velocity_range() const;
  /// The backend that was taken: never automatic.
  const Backend& backend() const;
  /// GL vendor, renderer and version in one line.
  std::string description() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace billow::render
