// Power iteration on forces that are filtered.
#include "sim/limit/filtered_eigenvalue.h"

#include "base/random.h"

namespace billow::sim {

// F M^-1 K is not symmetric, so the estimate is the growth of the norm instead of a Rayleigh quotient.
EigenvalueEstimate filtered_eigenvalue(const Structure& structure, const StiffnessMatrix& stiffness,
                                       const Filter& filter, const PowerOptions& options) {
  Eigen::MatrixX3d v =
      structure.inverse_mass.cwiseSign().asDiagonal() * seeded_noise(structure.particles(), options.seed);
  Eigen::MatrixX3d product;
  EigenvalueEstimate estimate;
  FilterScratch scratch;
  for (int k = 1; k <= options.max_iterations && !estimate.converged; ++k) {
    const double norm = v.norm();
    if (norm == 0.0) return {0.0, k, true};
    v /= norm;
    stiffness.multiply(v, product);
    product = structure.inverse_mass.asDiagonal() * product;
    filter.apply(structure.rest_position, 0.0, product, scratch);
    estimate = {product.norm(), k, settled(product.norm(), estimate.value, options.tolerance)};
    v.swap(product);
  }
  return estimate;
}

}  // namespace billow::sim
