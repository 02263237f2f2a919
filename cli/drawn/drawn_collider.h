// What is drawn of a collider.
#pragma once

#include <Eigen/Geometry>

#include "cli/scene/scene.h"
#include "render/frame/drawn_body.h"
#include "sim/drawn/surface.h"

namespace billow::cli {

/// Its surface, with sharp edges where it has them, carried along by its motion.
class DrawnCollider {
 public:
  /// `spec` must outlive this. A plane, which has no end, is drawn as a square around `bodies` [m], the bodies at the
  /// start, its texture once over every square metre.
  DrawnCollider(const ColliderSpec& spec, const Eigen::AlignedBox3d& bodies);

  render::DrawnBody drawn() const { return {surface_, spec_.finish, spec_.solid.name}; }
  /// Its mesh before the motion, as its file has it, or the square.
  const sim::Mesh& mesh() const { return spec_.solid.half_space ? square_ : spec_.solid.mesh; }
  /// Where its motion has points (p x 3) [m] of it at `time` [s], seen from `origin` [m].
  sim::SurfaceState carried(const Eigen::MatrixX3d& points, double time,
                            const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) const;
  /// The same of its surface.
  sim::SurfaceState at(double time, const Eigen::Vector3d& origin) const { return carried(position_, time, origin); }
  /// What of it a picture of `bodies` [m] should show, itself being at `state`: a small collider that is near them
  /// whole, of a larger one what is near them, of a plane nothing. A table must not make the cloth on it a dot.
  Eigen::AlignedBox3d framed(const sim::SurfaceState& state, const Eigen::AlignedBox3d& bodies) const;

 private:
  const ColliderSpec& spec_;
  Eigen::MatrixX3d position_;  // [m] (p x 3) before its motion
  sim::Surface surface_;
  sim::Mesh square_;  // of a plane
};

/// The box [m] around a surface.
Eigen::AlignedBox3d box_of(const sim::SurfaceState& state);

}  // namespace billow::cli
