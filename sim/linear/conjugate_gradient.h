// Preconditioned conjugate gradient on particle vectors, matrix-free.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace billow::sim {

/// y <- (operator) x on (n x 3) particle vectors; y has its size.
using ParticleOperator = std::function<void(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y)>;

struct ConjugateGradientResult {
  int iterations = 0;
  bool converged = false;
};

/// Its vectors, (n x 3) each: kept between solves, they take their memory once.
struct ConjugateGradientSpace {
  Eigen::MatrixX3d residual, preconditioned, direction, product;
};

/// Solves A x = b for a symmetric positive definite A, starting from the given x. Converged means
/// |b - A x| <= tolerance |b|. Sums run in a fixed order.
ConjugateGradientResult conjugate_gradient(const ParticleOperator& multiply, const ParticleOperator& precondition,
                                           const Eigen::MatrixX3d& b, double tolerance, int max_iterations,
                                           Eigen::MatrixX3d& x, ConjugateGradientSpace& space);

/// The first guess for a sequence of systems that changes slowly: of its last two solutions, `previous` becomes the
/// later one and `current` the next one on the line through both.
void extrapolate(Eigen::MatrixX3d& previous, Eigen::MatrixX3d& current);

}  // namespace billow::sim
