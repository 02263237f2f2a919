// Specks in the water: nothing that is simulated, but without them a camera beside a fish shows no way made.
#pragma once

#include <Eigen/Geometry>

#include "render/frame/mesh_renderer.h"
#include "sim/drawn/surface.h"

namespace billow::cli {

/// Specks spread evenly, from a fixed seed, over a box around the bodies. They drift with the current, and the box is
/// endless: what leaves it on one side comes in on the other.
class Motes {
 public:
  /// `position` (n x 3) [m] of all particles at the start; `current` [m/s].
  Motes(int count, const Eigen::MatrixX3d& position, const Eigen::Vector3d& current);

  render::DrawnBody drawn() const;
  /// At `time` [s], seen from a camera that has come `path` [m].
  sim::SurfaceState at(double time, const Eigen::Vector3d& path) const;

 private:
  Eigen::AlignedBox3f box_;
  Eigen::MatrixX3f middle_;  // [m] (count x 3)
  Eigen::RowVector3f current_;
  float radius_;  // [m]
};

}  // namespace billow::cli
