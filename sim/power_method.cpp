// Power iterations.
#include "sim/power_method.h"

#include <cmath>

#include "sim/random.h"

namespace billow::sim {

namespace {

bool settled(double next, double last, double tolerance) { return std::abs(next - last) <= tolerance * std::abs(next); }

}  // namespace

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

// F M^-1 K is not symmetric, so the estimate is the growth of the norm instead of a Rayleigh quotient.
EigenvalueEstimate filtered_eigenvalue(const Structure& structure, const StiffnessMatrix& stiffness,
                                       const Filter& filter, const PowerOptions& options) {
  Eigen::MatrixX3d v =
      structure.inverse_mass.cwiseSign().asDiagonal() * seeded_noise(structure.particles(), options.seed);
  Eigen::MatrixX3d product;
  EigenvalueEstimate estimate;
  for (int k = 1; k <= options.max_iterations && !estimate.converged; ++k) {
    const double norm = v.norm();
    if (norm == 0.0) return {0.0, k, true};
    v /= norm;
    stiffness.multiply(v, product);
    product = structure.inverse_mass.asDiagonal() * product;
    filter.apply(structure.rest_position, 0.0, product);
    estimate = {product.norm(), k, settled(product.norm(), estimate.value, options.tolerance)};
    v.swap(product);
  }
  return estimate;
}

std::optional<double> paper_step(Method method, double eigenvalue) {
  const std::optional<double> limit = paper_limit(method);
  if (!limit || eigenvalue <= 0.0) return std::nullopt;
  return *limit / std::sqrt(eigenvalue);
}

}  // namespace billow::sim
