// Lanczos's three-term recurrence. The basis is not kept: lost orthogonality only repeats eigenvalues already found.
#include "sim/linear/lanczos.h"

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

/// The tridiagonal matrix T that the recurrence makes, its largest eigenvalue and that one's vector.
struct Tridiagonal {
  std::vector<double> alpha, beta;  // beta[k] joins k and k + 1; the last joins nothing yet
  double largest = 0.0;
  std::vector<double> weight;  // unit vector

  void solve() {
    find_largest();
    find_vector();
  }

 private:
  std::size_t size() const { return alpha.size(); }
  double joint(std::size_t k) const { return beta[k]; }

  // Whether T has an eigenvalue above x: whether a pivot of T - x is positive (Sturm).
  bool reaches_above(double x) const {
    double pivot = alpha[0] - x;
    for (std::size_t k = 1; k < size() && pivot <= 0.0; ++k)
      pivot = alpha[k] - x - joint(k - 1) * joint(k - 1) / std::min(pivot, -1e-300);
    return pivot > 0.0;
  }

  void find_largest() {
    double low = *std::max_element(alpha.begin(), alpha.end()), high = low, widest = 0.0;
    for (std::size_t k = 0; k < size(); ++k) {  // Gershgorin
      const double radius = (k > 0 ? joint(k - 1) : 0.0) + (k + 1 < size() ? joint(k) : 0.0);
      high = std::max(high, alpha[k] + radius);
      widest = std::max(widest, std::abs(alpha[k]) + radius);
    }
    for (int step = 0; step < 200 && high - low > 1e-16 * widest; ++step) {
      const double middle = 0.5 * (low + high);
      (reaches_above(middle) ? low : high) = middle;
    }
    largest = high;
  }

  // From pivots downwards and upwards that meet where the vector is largest (a twisted factorisation).
  void find_vector() {
    const std::size_t n = size();
    std::vector<double> down(n), up(n);
    const auto pivot = [](double value) { return std::min(value, -1e-300); };
    for (std::size_t k = 0; k < n; ++k)
      down[k] = pivot(alpha[k] - largest - (k > 0 ? joint(k - 1) * joint(k - 1) / down[k - 1] : 0.0));
    for (std::size_t k = n; k-- > 0;)
      up[k] = pivot(alpha[k] - largest - (k + 1 < n ? joint(k) * joint(k) / up[k + 1] : 0.0));
    std::size_t twist = 0;
    double least = INFINITY;
    for (std::size_t k = 0; k < n; ++k)
      if (const double meeting = std::abs(down[k] + up[k] - (alpha[k] - largest)); meeting < least)
        least = meeting, twist = k;
    weight.assign(n, 1.0);
    for (std::size_t k = twist; k-- > 0;) weight[k] = -joint(k) / down[k] * weight[k + 1];
    for (std::size_t k = twist; k + 1 < n; ++k) weight[k + 1] = -joint(k) / up[k + 1] * weight[k];
    double square = 0.0;
    for (const double w : weight) square += w * w;
    for (double& w : weight) w /= std::sqrt(square);
  }
};

// Where the next vector would be rounding and nothing else, all that the first one holds has been found.
constexpr double rounding = 1e-14;

}  // namespace

// The small problem is solved at sizes that grow by an eighth.
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
    found.error = t.beta.back() * std::abs(t.weight.back());
    found.converged = ended || t.largest > options.stop_above ||
                      found.error <= options.tolerance * std::max(std::abs(t.largest), options.scale);
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
