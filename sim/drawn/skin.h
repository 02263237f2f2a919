// What is drawn of a body: a surface whose points follow the body's particles.
#pragma once

#include <Eigen/Core>

#include "sim/body/state.h"
#include "sim/body/structure.h"
#include "sim/drawn/surface.h"

namespace billow::sim {

/// A surface bound to the n particles of a body: each of its p points keeps its height and width in a frame that the
/// particles carry, x = middle + height up / |up| + width side / |side|. All three are fixed linear combinations of the
/// particles, so shared points cannot come apart; up and side are made unit vectors, so cross-sections keep their size.
struct Skin {
  Surface surface;
  Eigen::MatrixXf middle = {}, up = {}, side = {};  //     (p x n) empty: point i is particle i
  Eigen::VectorXf height = {}, width = {};          // [m] (p)
};

/// Where the skin of `body` is at `state`, and its exact velocity.
/// `origin` [m] is where it is seen from: single precision is finest around it.
SurfaceState pose(const Skin& skin, const Body& body, const State& state,
                  const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// Numbers (N) of all particles at the points (p) of the skin of `body`: each has the mean, by the same weights, of the
/// particles that its middle is made of.
Eigen::VectorXf at_points(const Skin& skin, const Body& body, const Eigen::VectorXd& of_particles);

}  // namespace billow::sim
