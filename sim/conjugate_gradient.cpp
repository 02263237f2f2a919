// Hestenes & Stiefel's method with a preconditioner (Golub & Van Loan, algorithm 11.5.1).
#include "sim/conjugate_gradient.h"

namespace billow::sim {

namespace {

double dot(const Eigen::MatrixX3d& a, const Eigen::MatrixX3d& b) { return a.cwiseProduct(b).sum(); }

}  // namespace

ConjugateGradientResult conjugate_gradient(const ParticleOperator& multiply, const ParticleOperator& precondition,
                                           const Eigen::MatrixX3d& b, double tolerance, int max_iterations,
                                           Eigen::MatrixX3d& x) {
  ConjugateGradientResult result;
  const double target = tolerance * tolerance * b.squaredNorm();
  if (b.squaredNorm() == 0.0) {  // no residual is small relative to it, so a guess would never be near enough
    x.setZero();
    return {0, true};
  }
  Eigen::MatrixX3d product, z, r = b;
  multiply(x, product);
  r -= product;
  precondition(r, z);
  Eigen::MatrixX3d direction = z;
  double rz = dot(r, z);
  result.converged = r.squaredNorm() <= target;
  while (!result.converged && result.iterations < max_iterations) {
    multiply(direction, product);
    const double alpha = rz / dot(direction, product);
    x += alpha * direction;
    r -= alpha * product;
    ++result.iterations;
    result.converged = r.squaredNorm() <= target;
    precondition(r, z);
    const double next = dot(r, z);
    direction = z + (next / rz) * direction;
    rz = next;
  }
  return result;
}

}  // namespace billow::sim
