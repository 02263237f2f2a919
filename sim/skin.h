// What is drawn of a body: a surface whose points follow the body's particles.
#pragma once

#include <Eigen/Core>

#include "sim/state.h"
#include "sim/structure.h"
#include "sim/surface.h"

namespace billow::sim {

/// A surface bound to the n particles of a body. Its p points are fixed linear combinations of theirs, so shared points
/// cannot come apart, and the same combinations of the particles' velocities are the exact velocities.
struct Skin {
  Surface surface;
  Eigen::MatrixXf weight;  // (p x n) rows sum to 1; empty: point i is particle i
};

/// Where the skin of `body` is at `state`.
SurfaceState pose(const Skin& skin, const Body& body, const State& state);

}  // namespace billow::sim
