// Preconditioned conjugate gradient on particle vectors, matrix-free.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace billow::sim {

/// y <- (operator) x on (n x 3) particle vectors.
using ParticleOperator = std::function<void(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y)>;

struct ConjugateGradientResult {
  int iterations = 0;
  bool converged = false;
};

/// Solves A x = b for a symmetric positive definite A, starting from the given x. Converged means
/// |b - A x| <= tolerance |b|. Sums run in a fixed order.
ConjugateGradientResult conjugate_gradient(const ParticleOperator& multiply, const ParticleOperator& precondition,
                                           const Eigen::MatrixX3d& b, double tolerance, int max_iterations,
                                           Eigen::MatrixX3d& x);

}  // namespace billow::sim
