// How a structure gives way to small loads: its linear equilibrium, assembled and solved directly.
#pragma once

#include "sim/body/structure.h"

namespace billow::test {

/// What is pushed, and what is held where.
struct Loading {
  Eigen::MatrixX3d force;                      // [N] (n x 3)
  Eigen::Array<bool, Eigen::Dynamic, 3> held;  //     (n x 3) along which axes
  Eigen::MatrixX3d displacement;               // [m] (n x 3) of what is held
};

/// None, on nothing held.
Loading no_load(const sim::Structure& structure);

/// Displacements [m] (n x 3) with K u = force, K being that of springs at rest with the tensions that they have there.
Eigen::MatrixX3d displacements(const sim::Structure& structure, const Loading& loading);

/// [N] (n x 3) that hold those displacements.
Eigen::MatrixX3d holding_forces(const sim::Structure& structure, const Eigen::MatrixX3d& displacements);

}  // namespace billow::test
