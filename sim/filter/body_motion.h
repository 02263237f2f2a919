// A body's motion as a whole, and taking it out of a field or putting it back.
#pragma once

#include <Eigen/Core>

#include "sim/body/structure.h"

namespace billow::sim {

/// Linear and angular momentum of one body about its centre of mass, and its inertia there.
struct BodyMotion {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  double mass = 0.0;
};

/// Of a field of velocities (n x 3) at `position` (n x 3).
BodyMotion body_motion(const Structure& structure, const Body& body, const Eigen::MatrixX3d& position,
                       const Eigen::MatrixX3d& field);

/// Adds the rigid motion V + omega x r that gives the body the momenta of `motion`; none for BodyMotion{}. A body on a
/// line has no inertia about it: that axis is left alone.
void set_momenta(const Structure& structure, const Body& body, const Eigen::MatrixX3d& position,
                 const BodyMotion& motion, Eigen::MatrixX3d& field);

/// Whether nothing of the body is pinned.
bool is_free(const Structure& structure, const Body& body);

}  // namespace billow::sim
