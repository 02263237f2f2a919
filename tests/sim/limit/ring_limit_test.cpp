// The step limits of every scheme with every filter on a ring, mode by mode, against their closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/step/step.h"
#include "tests/support/evaluations.h"
#include "tests/support/ring_of_modes.h"

namespace billow::sim {
namespace {

using test::LinearStep;
using Ring = test::RingOfModes;

constexpr IntegratorOptions exact_solver = {.linear_solver = LinearSolver::cholesky};

using LimitFormula = std::function<double(double g)>;  // limit of s = omega^2 h^2

void expect_limit(Method method, FilterTarget target, const LimitFormula& formula) {
  const Ring ring;
  for (const FilterOptions& options : test::filters_that_pass_every_mode_upright(target)) {
    const Filter filter(ring.structure, options);
    Step step(ring.forces, method, exact_solver, &filter, &ring.structure.rest_position);
    for (int p = 1; p <= Ring::n / 2; ++p) {
      const double expected = std::sqrt(formula(ring.response(options, p))) / ring.omega(p);
      EXPECT_NEAR(ring.limit(std::ref(step), p), expected, 1e-4 * expected)
          << name(method) << ", mode " << p << ", lambda = " << options.lambda;
    }
  }
}

TEST(RingLimit, OfFBEulerIsFour) {
  const Ring ring;
  Step step(ring.forces, Method::fb_euler, {}, nullptr);
  for (int p = 1; p <= Ring::n / 2; ++p)
    EXPECT_NEAR(ring.limit(std::ref(step), p), 2.0 / ring.omega(p), 2e-4 / ring.omega(p));
}

TEST(RingLimit, OfFBEulerWithAForceFilterIsFourOverG) {
  expect_limit(Method::fb_euler, FilterTarget::force, [](double g) { return 4.0 / g; });
}

TEST(RingLimit, OfFBEulerWithAVelocityFilterIsTwoOnePlusGOverG) {
  expect_limit(Method::fb_euler, FilterTarget::velocity, [](double g) { return 2.0 * (1.0 + g) / g; });
}

TEST(RingLimit, OfForwardEulerWithAVelocityFilterIsOneMinusGOverG) {
  expect_limit(Method::forward_euler, FilterTarget::velocity, [](double g) { return (1.0 - g) / g; });
}

TEST(RingLimit, OfVerletIsThatOfFBEuler) {
  expect_limit(Method::verlet, FilterTarget::force, [](double g) { return 4.0 / g; });
  expect_limit(Method::verlet, FilterTarget::velocity, [](double g) { return 2.0 * (1.0 + g) / g; });
}

TEST(RingLimit, OfRungeKuttaWithAForceFilterIsEightOverG) {
  expect_limit(Method::rk4, FilterTarget::force, [](double g) { return 8.0 / g; });
}

// The fifth row of the table: worse than no filter, which is why billow filters before.
TEST(RingLimit, WithVelocitiesFilteredAfterThePositionsIsTwoOnePlusG) {
  const Ring ring;
  for (const FilterOptions& options : test::filters_that_pass_every_mode_upright(FilterTarget::velocity)) {
    const Filter filter(ring.structure, options);
    Step unfiltered(ring.forces, Method::fb_euler, {}, nullptr);
    const LinearStep step = [&](State& state, double h) {
      unfiltered(state, h);
      test::apply(filter, ring.structure.rest_position, 0.0, state.velocity);
    };
    for (int p = 1; p <= Ring::n / 2; ++p) {
      const double expected = std::sqrt(2.0 * (1.0 + ring.response(options, p))) / ring.omega(p);
      EXPECT_NEAR(ring.limit(step, p), expected, 1e-4 * expected);
      EXPECT_LT(ring.limit(step, p), 2.0 / ring.omega(p));
    }
  }
}

TEST(RingLimit, OfForwardEulerAloneDoesNotExist) {
  const Ring ring;
  Step step(ring.forces, Method::forward_euler, {}, nullptr);
  for (int p = 1; p <= Ring::n / 2; ++p) EXPECT_EQ(ring.limit(std::ref(step), p), 0.0);
}

// g < 0: the filter turns the mode around, and each step pushes it on.
TEST(RingLimit, DoesNotExistForAModeThatTheFilterTurnsAround) {
  const Ring ring;
  for (const FilterTarget target : {FilterTarget::velocity, FilterTarget::force}) {
    const FilterOptions options{.lambda = 0.5, .target = target};
    ASSERT_LT(ring.response(options, Ring::n / 2), -0.05);
    const Filter filter(ring.structure, options);
    Step step(ring.forces, Method::fb_euler, {}, &filter, &ring.structure.rest_position);
    EXPECT_EQ(ring.limit(std::ref(step), Ring::n / 2), 0.0);
  }
}

}  // namespace
}  // namespace billow::sim
