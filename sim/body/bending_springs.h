// What a sheet's springs must carry at rest so that it bends like a plate of given rigidity, whatever its mesh.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/body/cloth_springs.h"
#include "sim/mesh/mesh.h"

namespace billow::sim {

/// Tension per length [N/m] (m) that the springs of `mesh` (cloth_springs with BendLines::edges_and_diagonals) carry at
/// rest, negative where they push: in balance on a flat sheet, and with the energy 1/2 rigidity kappa^2 per area when
/// it is rolled up to the curvature kappa [1/m], in whichever direction. `rigidity` [N m] is the moment per width and
/// curvature; Poisson's ratio is 1/3. Curved sheets are taken as flat around each vertex, and rest flat.
Eigen::VectorXd bending_force_density(const Mesh& mesh, const std::vector<SpringPair>& springs, double rigidity);

}  // namespace billow::sim
