// Hestenes & Stiefel's method with a preconditioner (Golub & Van Loan, algorithm 11.5.1).
#include "sim/linear/conjugate_gradient.h"

#include <algorithm>
#include <cmath>

namespace billow::sim {

namespace {

double dot(const Eigen::MatrixX3d& a, const Eigen::MatrixX3d& b) { return a.cwiseProduct(b).sum(); }

bool positive(double value) { return value > 0.0 && std::isfinite(value); }

// Each iteration takes what it believes it gained from the residual, and rounding makes that drift from b - A x: by
// 1e-16 of the largest that it was, times the condition number at worst. A residual smaller than this share of the
// largest is computed from x before it is believed.
constexpr double believed_share = 1e-6;

}  // namespace

void ConjugateGradient::start(const LinearSystem& system, const Eigen::MatrixX3d& b, Eigen::MatrixX3d& x) {
  system_ = &system, b_ = &b, x_ = &x;
  for (Eigen::MatrixX3d* vector : {&preconditioned_, &direction_, &product_}) vector->resize(b.rows(), 3);
  b_square_ = b.squaredNorm();
  iterations_ = 0;
  begin();
  if (std::isfinite(residual_square_)) return;
  x.setZero();
  begin();
}

// From x as it is.
void ConjugateGradient::begin() {
  system_->multiply(*x_, product_);
  residual_ = *b_ - product_;
  residual_square_ = began_with_ = residual_.squaredNorm();
  largest_square_ = std::max(b_square_, residual_square_);
  rz_ = 0.0;
  broken_ = !std::isfinite(residual_square_);
}

SolveState ConjugateGradient::solve(double tolerance, int max_iterations) {
  if (b_square_ == 0.0 && b_->isZero(0.0)) {  // no residual is small relative to it: a guess would never be near enough
    x_->setZero(), residual_.setZero();
    return SolveState::converged;
  }
  const double target = tolerance * tolerance * b_square_;
  broken_ = broken_ || !std::isnormal(target);
  while (!broken_) {
    if (residual_square_ <= target && (is_believed(target) || confirm(target))) return SolveState::converged;
    if (iterations_ >= max_iterations) return SolveState::out_of_iterations;
    broken_ = broken_ || !iterate();
  }
  if (!x_->allFinite()) x_->setZero();
  return SolveState::breakdown;
}

bool ConjugateGradient::is_believed(double target) const {
  return target >= believed_share * believed_share * largest_square_;
}

// Whether b - A x itself is as small. If not, all begins again from x, as long as that still gains.
bool ConjugateGradient::confirm(double target) {
  const double before = began_with_;
  begin();
  broken_ = broken_ || (residual_square_ > target && residual_square_ > 0.25 * before);
  return residual_square_ <= target;
}

// False, with x as it was, where there is no way on.
bool ConjugateGradient::iterate() {
  system_->precondition(residual_, preconditioned_);
  const double next = dot(residual_, preconditioned_);
  if (rz_ == 0.0)
    direction_ = preconditioned_;
  else
    direction_ = preconditioned_ + (next / rz_) * direction_;
  rz_ = next;
  system_->multiply(direction_, product_);
  const double curvature = dot(direction_, product_), alpha = rz_ / curvature;
  if (!positive(rz_) || !positive(curvature) || !positive(alpha)) return false;
  *x_ += alpha * direction_;
  residual_ -= alpha * product_;
  residual_square_ = residual_.squaredNorm();
  largest_square_ = std::max(largest_square_, residual_square_);
  ++iterations_;
  return std::isfinite(residual_square_);
}

void extrapolate(Eigen::MatrixX3d& previous, Eigen::MatrixX3d& current) {
  previous = 2.0 * current - previous;
  previous.swap(current);
}

}  // namespace billow::sim
