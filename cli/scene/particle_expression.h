// Formulas over the particles of a body, as scenes write them.
#pragma once

#include <Eigen/Core>
#include <string>

#include "sim/mesh/mesh.h"

namespace billow::cli {

/// The values (n) of `expression` at n rest positions [m] (n x 3). Every formula of a scene comes through here. The
/// expression is muParser's, of at most 1000 characters and with one value: + - * / ^, comparisons, && || ?:, functions
/// such as sqrt, exp, sin, min, max, and
///   x, y, z              the particle's rest position [m]
///   red, green, blue     its vertex colour in the mesh, in [0, 1]; 1 where the mesh has none
///   group("NAME")        1 for the vertices of that group of the mesh, else 0
/// Nothing can be set. `mesh` may have no vertices (a body that is not made of its mesh): colours are then 1 and groups
/// unknown. Throws InputError, one line without a place in the file, on a fault of the expression, which is shown
/// around its character, or a value that is not finite.
Eigen::VectorXd evaluate_at_particles(const std::string& expression, const Eigen::MatrixX3d& position,
                                      const sim::Mesh& mesh);

}  // namespace billow::cli
