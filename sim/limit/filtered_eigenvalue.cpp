// Lanczos where the filter is self-adjoint, Arnoldi where not.
#include "sim/limit/filtered_eigenvalue.h"

#include "sim/linear/arnoldi.h"
#include "sim/linear/lanczos.h"

namespace billow::sim {

EigenvalueEstimate filtered_eigenvalue(const Structure& structure, const StiffnessMatrix& stiffness,
                                       const Filter& filter, const EigenvalueOptions& options) {
  FilterScratch scratch;
  const ParticleOperator acceleration = [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
    stiffness.multiply(x, y);
    y = structure.inverse_mass.asDiagonal() * y;
  };
  const ParticleOperator filtered = [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
    y = x;
    filter.apply(structure.rest_position, 0.0, y, scratch);
  };
  if (filter.nonnegative()) {
    const ExtremeEigenvalue found = largest_eigenvalue(
        {acceleration, filtered, free_mass(structure)},
        {.tolerance = options.tolerance, .max_iterations = options.max_iterations, .seed = options.seed});
    return {found.value, found.iterations, found.converged, found.error};
  }
  Eigen::MatrixX3d unfiltered;
  const auto both = [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
    acceleration(x, unfiltered);
    filtered(unfiltered, y);
  };
  const LargestModulus found =
      largest_modulus(both, free_mass(structure),
                      {.max_iterations = options.max_iterations, .tolerance = options.tolerance, .seed = options.seed});
  return {found.value, found.iterations, found.converged, found.residual};
}

}  // namespace billow::sim
