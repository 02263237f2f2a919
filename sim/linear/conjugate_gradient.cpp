// Hestenes & Stiefel's method with a preconditioner (Golub & Van Loan, algorithm 11.5.1).
#include "sim/linear/conjugate_gradient.h"

namespace billow::sim {

namespace {

double dot(const Eigen::MatrixX3d& a, const Eigen::MatrixX3d& b) { return a.cwiseProduct(b).sum(); }

}  // namespace

ConjugateGradientResult conjugate_gradient(const ParticleOperator& multiply, const ParticleOperator& precondition,
                                           const Eigen::MatrixX3d& b, double tolerance, int max_iterations,
                                           Eigen::MatrixX3d& x, ConjugateGradientSpace& space) {
  const double target = tolerance * tolerance * b.squaredNorm();
  if (b.squaredNorm() == 0.0) {  // no residual is small relative to it, so a guess would never be near enough
    x.setZero();
    return {0, true};
  }
  auto& [r, z, direction, product] = space;
  for (Eigen::MatrixX3d* vector : {&z, &direction, &product}) vector->resize(b.rows(), 3);
  multiply(x, product);
  r = b - product;
  ConjugateGradientResult result{0, r.squaredNorm() <= target};
  double rz = 1.0;
  while (!result.converged && result.iterations < max_iterations) {
    precondition(r, z);
    const double next = dot(r, z);
    if (result.iterations == 0)
      direction = z;
    else
      direction = z + (next / rz) * direction;
    rz = next;
    multiply(direction, product);
    const double alpha = rz / dot(direction, product);
    x += alpha * direction;
    r -= alpha * product;
    ++result.iterations;
    result.converged = r.squaredNorm() <= target;
  }
  return result;
}

void extrapolate(Eigen::MatrixX3d& previous, Eigen::MatrixX3d& current) {
  previous = 2.0 * current - previous;
  previous.swap(current);
}

}  // namespace billow::sim
