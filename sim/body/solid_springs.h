// What a braced surface's springs must be so that it is strained like a solid of a given modulus, whatever its mesh.
#pragma once

#include <Eigen/Core>

#include "sim/body/structure.h"
#include "sim/mesh/mesh.h"

namespace billow::sim {

/// [N/m] (m) of the springs of `body`, the soft body of `mesh` with all of its interior pairs: each vertex's together
/// hold against every even strain the force with which an isotropic solid of Young's modulus `young` [Pa] pulls at its
/// part of the surface, as nearly as springs that only resist, k >= 0, can. Poisson's ratio is 1/4, that of all solids
/// of springs. Springs that are not needed get 0.
Eigen::VectorXd solid_stiffness(const Mesh& mesh, const Structure& body, double young);

}  // namespace billow::sim
