// Lanczos's three-term recurrence. The basis is not kept: lost orthogonality only repeats eigenvalues already found.
#include "sim/linear/lanczos.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"

namespace billow::sim {

namespace {

/// The vectors q(1), q(2), ... of beta(k+1) q(k+1) = B G q(k) - alpha(k) q(k) - beta(k) q(k-1), orthonormal in x . M G
/// y.
class Recurrence {
 public:
  Recurrence(const SymmetricProduct& product, std::uint64_t seed) : product_(product) {
    const auto n = static_cast<int>(product.inner_mass.size());
    residual_ = product.inner_mass.cwiseSign().asDiagonal() * seeded_noise(n, seed);
    next_beta_ = weigh();
    current_.setZero(n, 3);
    previous_.setZero(n, 3);
  }

  /// The norm of what is left to make the next vector of: 0 where there is none.
  double next_beta() const { return next_beta_; }

  /// Goes on to the next vector q; returns its alpha. *sum += weight G q where there is a sum.
  double advance(double weight = 0.0, Eigen::MatrixX3d* sum = nullptr) {
    const double beta = started_ ? next_beta_ : 0.0;
    started_ = true;
    previous_.swap(current_);
    current_ = residual_ / next_beta_;
    if (product_.inner) weighted_ /= next_beta_;
    product_.outer(weighted(), residual_);
    const double alpha = dot(weighted(), residual_);
    residual_ -= alpha * current_ + beta * previous_;
    if (sum) *sum += weight * weighted();
    next_beta_ = weigh();
    return alpha;
  }

 private:
  const Eigen::MatrixX3d& weighted() const { return product_.inner ? weighted_ : current_; }

  double dot(const Eigen::MatrixX3d& a, const Eigen::MatrixX3d& b) const {
    return a.cwiseProduct(b).rowwise().sum().dot(product_.inner_mass);
  }

  // The residual's norm, and G times it.
  double weigh() {
    if (product_.inner) product_.inner(residual_, weighted_);
    const double square = dot(product_.inner ? weighted_ : residual_, residual_);
    return square > 0.0 ? std::sqrt(square) : 0.0;
  }

  const SymmetricProduct& product_;
  Eigen::MatrixX3d previous_, current_, residual_, weighted_;
  double next_beta_ = 0.0;
  bool started_ = false;
};

/// The tridiagonal matrix that the recurrence makes, and its largest eigenvalue.
struct Tridiagonal {
  std::vector<double> alpha, beta;  // beta[k] joins k and k + 1
  double largest = 0.0;
  Eigen::VectorXd weight;  // the eigenvector

  void solve() {
    const auto size = static_cast<Eigen::Index>(alpha.size());
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(alpha.data(), size),
                                  Eigen::Map<const Eigen::VectorXd>(beta.data(), size - 1));
    largest = solver.eigenvalues()(size - 1);
    weight = solver.eigenvectors().col(size - 1);
  }
};

// Where the next vector would be rounding and nothing else, all that the first one holds has been found.
constexpr double rounding = 1e-14;

}  // namespace

// Solving the small problem costs the cube of its size, so it is done at sizes that grow by an eighth.
ExtremeEigenvalue largest_eigenvalue(const SymmetricProduct& product, const LanczosOptions& options,
                                     Eigen::MatrixX3d* vector) {
  Recurrence recurrence(product, options.seed);
  Tridiagonal t;
  ExtremeEigenvalue found;
  if (recurrence.next_beta() == 0.0) {  // nothing is free to move
    if (vector) vector->setZero(product.inner_mass.size(), 3);
    return {.converged = true};
  }
  for (int look = 4; !found.converged && found.iterations < options.max_iterations;) {
    t.alpha.push_back(recurrence.advance());
    t.beta.push_back(recurrence.next_beta());
    ++found.iterations;
    const bool ended = !(t.beta.back() > rounding * std::abs(t.alpha.front()));
    if (found.iterations < look && !ended && found.iterations < options.max_iterations) continue;
    look = found.iterations + std::max(4, found.iterations / 8);
    t.solve();
    found.value = t.largest;
    found.error = t.beta.back() * std::abs(t.weight.tail<1>()(0));
    found.converged = ended || found.error <= options.tolerance * std::max(std::abs(t.largest), options.scale);
    if (!std::isfinite(found.value)) break;
  }
  if (vector) {
    Recurrence again(product, options.seed);
    vector->setZero(product.inner_mass.size(), 3);
    for (const double weight : t.weight) again.advance(weight, vector);
  }
  return found;
}

}  // namespace billow::sim
