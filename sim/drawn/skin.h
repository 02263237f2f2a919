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
SurfaceState pose(const Skin& skin, const Body& body, const State& state);

/// Strain (p) of the skin's points: of a particle the mean of |l / l_0 - 1| over its structural springs, 0 where it has
/// none; of a point the mean of its particles' with the weights of their middle.
Eigen::VectorXf strain(const Skin& skin, const Structure& structure, const Body& body, const State& state);

}  // namespace billow::sim
