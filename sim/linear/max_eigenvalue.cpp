// M^-1 K as Lanczos's iteration takes it.
#include "sim/linear/max_eigenvalue.h"

#include "sim/linear/lanczos.h"

namespace billow::sim {

EigenvalueEstimate max_eigenvalue(const Structure& structure, const StiffnessMatrix& stiffness,
                                  const EigenvalueOptions& options, Eigen::MatrixX3d* mode) {
  const auto acceleration = [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
    stiffness.multiply(x, y);
    y = structure.inverse_mass.asDiagonal() * y;
  };
  const ExtremeEigenvalue found = largest_eigenvalue(
      {acceleration, {}, free_mass(structure)},
      {.tolerance = options.tolerance, .max_iterations = options.max_iterations, .seed = options.seed}, mode);
  return {found.value, found.iterations, found.converged, found.error};
}

}  // namespace billow::sim
