// The power iteration.
#include "sim/linear/power_method.h"

#include <cmath>

#include "base/random.h"

namespace billow::sim {

bool settled(double next, double last, double tolerance) { return std::abs(next - last) <= tolerance * std::abs(next); }

EigenvalueEstimate max_eigenvalue(const Structure& structure, const StiffnessMatrix& stiffness,
                                  const PowerOptions& options, Eigen::MatrixX3d* mode) {
  const Eigen::VectorXd root = structure.inverse_mass.cwiseSqrt();
  Eigen::MatrixX3d v = root.asDiagonal() * seeded_noise(structure.particles(), options.seed);
  Eigen::MatrixX3d product;
  EigenvalueEstimate estimate;
  for (int k = 1; k <= options.max_iterations && !estimate.converged; ++k) {
    const double norm = v.norm();
    if (norm == 0.0) {  // nothing is free to move, or nothing resists
      if (mode) *mode = v;
      return {0.0, k, true};
    }
    v /= norm;
    stiffness.multiply(root.asDiagonal() * v, product);
    product = root.asDiagonal() * product;
    const double next = v.cwiseProduct(product).sum();
    estimate = {next, k, settled(next, estimate.value, options.tolerance)};
    v.swap(product);
  }
  if (mode) *mode = root.asDiagonal() * v;
  return estimate;
}

}  // namespace billow::sim
