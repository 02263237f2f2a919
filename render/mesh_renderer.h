// Draws the bodies of a scene into an Image, offscreen.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "render/image.h"
#include "render/settings.h"
#include "sim/surface.h"

namespace billow::render {

/// One body as the renderer needs it for a whole run.
struct DrawnBody {
  sim::Surface surface;
  Image texture;                                      // empty: plain `colour`
  Eigen::Vector3f colour{0.4564f, 0.4564f, 0.4564f};  // linear-light RGB in [0, 1]
};

/// What holds for every frame of a run and is known before the first one is drawn.
struct RunBounds {
  Eigen::AlignedBox3d box;      // [m]   all positions of all frames: fits the camera, the ground and the shadow map
  double velocity_scale = 1.0;  // [m/s] v_max of the velocity view when the settings give none
};

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

  /// One frame of one view: RGB, settings.width x settings.height. `bodies[b]` belongs to the b-th DrawnBody.
  Image draw(View view, const std::vector<sim::SurfaceState>& bodies);

  /// The v_max [m/s] in use.
  double velocity_range() const;
  /// GL vendor, renderer and version in one line.
  std::string description() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace billow::render
