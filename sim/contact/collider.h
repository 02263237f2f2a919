// What bodies touch and cannot move.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "sim/body/keyed_motion.h"
#include "sim/mesh/mesh.h"

namespace billow::sim {

/// A half-space: all x with normal . (x - point) < 0 is solid.
struct HalfSpace {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();  // unit
};

/// All points within `radius` of a segment: a ball where its ends are the same.
struct Rounded {
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();  // [m]
  double radius = 1.0;                                                           // [m] > 0
};

/// Something solid, or a rigid sheet, that moves by keys and by nothing else.
struct Collider {
  std::string name;
  // What is touched: a half-space, something rounded, or else the mesh. Where they are before the motion.
  std::optional<HalfSpace> half_space = {};
  std::optional<Rounded> rounded = {};
  Mesh mesh = {};            // what is drawn of something rounded, inside of it
  double thickness = 0.001;  // [m] of a layer around it that others stay out of
  double friction = 0.3;     // Coulomb's, of it against its like
  KeyedMotion motion;
};

}  // namespace billow::sim
