#include "tests/support/ring_of_modes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace billow::test {

using std::numbers::pi;

double RingOfModes::omega(int p) const { return 2.0 * std::sqrt(stiffness / mass) * std::sin(p * pi / n); }

double RingOfModes::response(const sim::FilterOptions& options, int p) const {
  const double e = std::exp(-options.lambda), plain = (1.0 + 2.0 * e * std::cos(2.0 * pi * p / n)) / (1.0 + 2.0 * e);
  return std::pow(options.form == sim::FilterForm::symmetric ? 0.5 * (1.0 + plain) : plain, options.passes);
}

double RingOfModes::radius(const LinearStep& step, int p, double h) const {
  Eigen::VectorXd mode(n);
  for (int i = 0; i < n; ++i) mode(i) = std::cos(2.0 * pi * p * i / n);
  Eigen::Matrix2d map;
  for (int c = 0; c < 2; ++c) {
    sim::State state{Eigen::MatrixX3d::Zero(n, 3), Eigen::MatrixX3d::Zero(n, 3), 0.0};
    (c == 0 ? state.position : state.velocity).col(0) = mode * (c == 0 ? 1.0 : omega(p));
    step(state, h);
    map(0, c) = mode.dot(state.position.col(0)) / mode.squaredNorm();
    map(1, c) = mode.dot(state.velocity.col(0)) / mode.squaredNorm() / omega(p);
    EXPECT_LT((state.position.col(0) - map(0, c) * mode).norm(), 1e-10 * (1.0 + std::abs(map(0, c))));
  }
  return spectral_radius(map);
}

double RingOfModes::limit(const LinearStep& step, int p) const {
  const auto stable = [&](double h) { return radius(step, p, h) <= 1.0 + 1e-9; };
  double low = 1e-3 / omega(p), high = 100.0 / omega(p);
  if (!stable(low)) return 0.0;
  EXPECT_FALSE(stable(high));
  while (high - low > 1e-7 * high) {
    const double middle = 0.5 * (low + high);
    (stable(middle) ? low : high) = middle;
  }
  return low;
}

std::vector<sim::FilterOptions> filters_that_pass_every_mode_upright(sim::FilterTarget target) {
  return {{.lambda = 1.0, .target = target},
          {.lambda = 2.5, .target = target},
          {.lambda = 0.5, .form = sim::FilterForm::symmetric, .target = target},
          {.lambda = 1.0, .form = sim::FilterForm::symmetric, .target = target, .passes = 3}};
}

}  // namespace billow::test
