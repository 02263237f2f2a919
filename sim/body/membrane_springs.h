// What a sheet's springs must be so that it stretches like a membrane of given moduli, whatever its mesh.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/body/cloth_springs.h"
#include "sim/mesh/mesh.h"

namespace billow::sim {

/// Force per width and strain of a strip that is pulled, and per radian that it is sheared.
struct MembraneModuli {
  double stretch;  // [N/m]
  double shear;    // [N/m]
};

/// Of a sheet that is alike in all directions: springs then have Poisson's ratio 1/3, and G = E / (2 (1 + 1/3)).
inline MembraneModuli isotropic_membrane(double stretch) { return {stretch, 0.375 * stretch}; }

/// [N/m] of a square grid's edges, whose diagonals have the shear modulus, so that the grid has both (docs/method.md).
double edge_stiffness(const MembraneModuli& moduli);

/// [N/m] (m) of the springs of `mesh` (cloth_springs), so that those of every face together resist its strains as the
/// membrane does, as nearly as springs that only resist, k >= 0, can; over the whole mesh their mean is exact. Bend
/// springs get 0. Threads run along the quads' sides; triangles are alike in all directions only with
/// isotropic_membrane.
Eigen::VectorXd membrane_stiffness(const Mesh& mesh, const std::vector<SpringPair>& springs,
                                   const MembraneModuli& moduli);

}  // namespace billow::sim
