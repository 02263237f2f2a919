// Draws the bodies of a scene into an Image, offscreen.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/frame/drawn_body.h"
#include "render/image/picture.h"
#include "render/image/settings.h"
#include "sim/drawn/surface.h"

namespace billow::render {

/// An OSMesa context with the run's meshes and textures in it. Not thread-safe: use it from the thread that made it.
class MeshRenderer {
 public:
  /// `threads` rasterise (0: one per core); the first renderer of the process decides for all, and LP_NUM_THREADS in
  /// the environment wins. The pixels do not depend on it.
  /// Throws InputError on an image size the GL cannot do, std::runtime_error when there is no GL.
  MeshRenderer(const Settings& settings, std::vector<DrawnBody> bodies, const RunBounds& bounds, int threads = 0);
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
  /// GL vendor, renderer and version in one line.
  std::string description() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace billow::render
