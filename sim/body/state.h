// Everything that a step may change. Copying it is a snapshot; comparing it proves determinism.
#pragma once

#include <Eigen/Core>

#include "sim/body/structure.h"

namespace billow::sim {

/// Positions, velocities and time of n particles.
struct State {
  Eigen::MatrixX3d position;  // [m]   (n x 3)
  Eigen::MatrixX3d velocity;  // [m/s] (n x 3)
  double time = 0.0;          // [s]
};

/// position += h velocity
void move(State& state, double h);

/// The structure at rest at time 0.
State rest_state(const Structure& structure);

}  // namespace billow::sim
