// Krylov spaces with an orthonormal basis, one after another.
#include "sim/linear/arnoldi.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"

namespace billow::sim {

namespace {

/// A Krylov space: its basis, orthonormal with the masses as weights, and the operator in it.
class KrylovSpace {
 public:
  KrylovSpace(const ParticleOperator& multiply, const Eigen::VectorXd& mass, int dimension)
      : multiply_(multiply), mass_(mass), dimension_(dimension) {}

  /// Fills the space from `start`; returns the products that it took.
  int fill(const Eigen::MatrixX3d& start) {
    basis_.assign(1, start / std::sqrt(dot(start, start)));
    projected_.setZero(dimension_ + 1, dimension_);
    for (int k = 0; k < dimension_; ++k) {
      multiply_(basis_[k], product_);
      orthogonalise(k);
      const double left = std::sqrt(dot(product_, product_));
      projected_(k + 1, k) = left;
      if (!(left > rounding * projected_.col(k).norm())) return finish(k + 1, 0.0);
      basis_.push_back(product_ / left);
    }
    return finish(dimension_, projected_(dimension_, dimension_ - 1));
  }

  double modulus() const { return modulus_; }
  double residual() const { return residual_; }
  /// The eigenvector, or the sum of its real and imaginary parts.
  Eigen::MatrixX3d vector() const {
    Eigen::MatrixX3d sum = Eigen::MatrixX3d::Zero(basis_[0].rows(), 3);
    for (Eigen::Index k = 0; k < weight_.size(); ++k) sum += (weight_(k).real() + weight_(k).imag()) * basis_[k];
    return sum;
  }

 private:
  static constexpr double rounding = 1e-14;

  double dot(const Eigen::MatrixX3d& a, const Eigen::MatrixX3d& b) const {
    return a.cwiseProduct(b).rowwise().sum().dot(mass_);
  }

  // Twice, because once leaves what rounding brings back.
  void orthogonalise(int k) {
    for (int pass = 0; pass < 2; ++pass)
      for (int j = 0; j <= k; ++j) {
        const double along = dot(basis_[j], product_);
        projected_(j, k) += along;
        product_ -= along * basis_[j];
      }
  }

  int finish(int size, double beyond) {
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(projected_.topLeftCorner(size, size));
    if (solver.info() != Eigen::Success) {  // the operator gave what is no number
      modulus_ = residual_ = NAN;
      return size;
    }
    Eigen::Index best = 0;
    modulus_ = solver.eigenvalues().cwiseAbs().maxCoeff(&best);
    weight_ = solver.eigenvectors().col(best).normalized();
    residual_ = beyond * std::abs(weight_(size - 1));
    return size;
  }

  const ParticleOperator& multiply_;
  const Eigen::VectorXd& mass_;
  int dimension_;
  std::vector<Eigen::MatrixX3d> basis_;
  Eigen::MatrixXd projected_;
  Eigen::MatrixX3d product_;
  Eigen::VectorXcd weight_;
  double modulus_ = 0.0, residual_ = 0.0;
};

}  // namespace

LargestModulus largest_modulus(const ParticleOperator& multiply, const Eigen::VectorXd& inner_mass,
                               const ArnoldiOptions& options) {
  const auto n = static_cast<int>(inner_mass.size());
  Eigen::MatrixX3d start = inner_mass.cwiseSign().asDiagonal() * seeded_noise(n, options.seed);
  LargestModulus found;
  KrylovSpace space(multiply, inner_mass, options.dimension);
  while (!found.converged && found.iterations < options.max_iterations) {
    if (start.squaredNorm() == 0.0) return {.converged = true};  // nothing is free to move
    found.iterations += space.fill(start);
    found.value = space.modulus();
    found.residual = space.residual();
    found.converged = found.residual <= options.tolerance * found.value;
    if (!std::isfinite(found.value)) break;
    start = space.vector();
  }
  return found;
}

}  // namespace billow::sim
