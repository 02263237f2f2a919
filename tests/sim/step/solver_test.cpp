// Stepping through time: no drift, exact sampling, divergence seen at once, the same run twice.
#include "sim/step/solver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::grid;
using test::oscillator;
using test::shaken_state;
using testing::HasSubstr;

Structure sheet() {
  Structure structure = test::light_cloth(6, 6, {0, 5});
  structure.body[0].name = "drape";
  return structure;
}

TEST(Solver, EndsStepKAtKTimesHHoweverLongItRuns) {
  const Structure structure = oscillator(1.0, 1.0);
  const Forces forces(structure, Eigen::Vector3d::Zero());
  State start = rest_state(structure);
  start.time = 0.25;
  Solver solver(structure, forces, {.step = 0.1}, start);
  for (long k = 1; k <= 100000; ++k) {
    solver.advance();
    ASSERT_EQ(solver.state().time, 0.25 + static_cast<double>(k) * 0.1);
  }
  EXPECT_EQ(solver.steps(), 100000);
}

TEST(Solver, SamplesAtStepTimesAreTheSteps) {
  const Structure structure = sheet();
  const Forces forces(structure, {0.0, -9.81, 0.0});
  Solver stepped(structure, forces, {.step = 0.001}, rest_state(structure));
  Solver sampled(structure, forces, {.step = 0.001}, rest_state(structure));
  EXPECT_EQ(sampled.sample(0.0).position, structure.rest_position);
  for (int k = 1; k <= 50; ++k) {
    stepped.advance();
    const State state = sampled.sample(k * 0.001);
    ASSERT_EQ(state.position, stepped.state().position) << k;
    ASSERT_EQ(state.velocity, stepped.state().velocity) << k;
  }
  EXPECT_EQ(sampled.steps(), 50);
}

// RK4 is exact enough that the error left is the interpolation's: cubic in position, linear in velocity.
TEST(Solver, InterpolatesBetweenStepsToSecondOrderOrBetter) {
  const Structure structure = oscillator(1.0, 1.0);
  const Forces forces(structure, Eigen::Vector3d::Zero());
  const auto worst_errors = [&](double h) {
    State start = rest_state(structure);
    start.position(1, 0) += 0.1;
    Solver solver(structure, forces, {.method = Method::rk4, .step = h}, start);
    Eigen::Vector2d worst = Eigen::Vector2d::Zero();
    for (double t = 0.05; t < 6.0; t += 0.0173) {
      const State state = solver.sample(t);
      EXPECT_EQ(state.time, t);
      worst = worst.cwiseMax(Eigen::Vector2d(std::abs(state.position(1, 0) - 1.0 - 0.1 * std::cos(t)),
                                             std::abs(state.velocity(1, 0) + 0.1 * std::sin(t))));
    }
    return worst;
  };
  const Eigen::Vector2d coarse = worst_errors(0.2), fine = worst_errors(0.1);
  EXPECT_LT(fine(0), 1e-5 * 0.1);
  EXPECT_GT(coarse(0) / fine(0), 12.0) << "positions: fourth order";
  EXPECT_GT(coarse(1) / fine(1), 3.5) << "velocities: second order";
}

TEST(Solver, SamplesTheLastStepAgainAfterOneThatFellOnItsEnd) {
  const Structure structure = oscillator(1.0, 1.0);
  const Forces forces(structure, Eigen::Vector3d::Zero());
  State start = rest_state(structure);
  start.position(1, 0) += 0.1;
  const SolverOptions options{.method = Method::rk4, .step = 0.1};
  Solver solver(structure, forces, options, start);
  for (const double time : {0.05, 1.0, 0.95, 2.0, 1.91}) {
    const double exact = 1.0 + 0.1 * std::cos(time);
    EXPECT_NEAR(solver.sample(time).position(1, 0), exact, 1e-6) << time;
  }
}

TEST(Solver, SamplingDoesNotChangeTheRun) {
  const Structure structure = sheet();
  const Forces forces(structure, {0.0, -9.81, 0.0});
  Solver rarely(structure, forces, {.step = 0.001}, rest_state(structure));
  Solver often(structure, forces, {.step = 0.001}, rest_state(structure));
  for (double t = 0.0; t < 0.2; t += 0.00037) often.sample(t);
  EXPECT_EQ(rarely.sample(0.25).position, often.sample(0.25).position);
}

TEST(Solver, RunsTwiceToTheSameBits) {
  Structure structure = sheet();
  structure.damping.setConstant(0.001);
  const Forces forces(structure, {0.0, -9.81, 0.0});
  for (const Method method :
       {Method::forward_euler, Method::fb_euler, Method::verlet, Method::rk4, Method::backward_euler, Method::imex}) {
    SolverOptions options{.method = method, .filter = FilterOptions{}, .step = 0.001};
    options.filter->form = FilterForm::conserving;
    options.filter->distances = FilterDistances::current;
    const auto end = [&] {
      return Solver(structure, forces, options, shaken_state(structure, 0.001, 0.1)).sample(0.3);
    };
    const State a = end(), b = end();
    EXPECT_EQ(a.position, b.position) << name(method);
    EXPECT_EQ(a.velocity, b.velocity) << name(method);
  }
}

TEST(Solver, HoldsPinnedParticlesWhateverTheInitialVelocity) {
  const Structure structure = sheet();
  const Forces forces(structure, {0.0, -9.81, 0.0});
  State start = rest_state(structure);
  start.velocity.setConstant(0.1);
  Solver solver(structure, forces, {.step = 0.001}, start);
  const State end = solver.sample(0.1005);
  for (const int pin : {0, 5}) {
    EXPECT_EQ(end.position.row(pin), start.position.row(pin));
    EXPECT_TRUE(end.velocity.row(pin).isZero(0.0));
  }
}

TEST(Solver, RefusesAStepThatIsNotPositive) {
  const Structure structure = sheet();
  const Forces forces(structure, Eigen::Vector3d::Zero());
  for (const double step : {0.0, -0.001, std::nan("")})
    EXPECT_THROW(Solver(structure, forces, {.step = step}, rest_state(structure)), InputError);
}

double largest_strain(const Structure& structure, const State& state) {
  double largest = 0.0;
  for (int s = 0; s < structure.springs(); ++s) {
    const double length =
        (state.position.row(structure.spring(s, 0)) - state.position.row(structure.spring(s, 1))).norm();
    largest = std::max(largest, std::isfinite(length) ? length / structure.rest_length(s) - 1.0 : HUGE_VAL);
  }
  return largest;
}

// Two copies of a run that blows up: one through the solver, one through its bare step.
TEST(Divergence, IsNoticedWithinAFewStepsAndNeverAfterNumbersAreLost) {
  const Structure structure = sheet();
  const Forces forces(structure, {0.0, -9.81, 0.0});
  for (const Method method : {Method::forward_euler, Method::fb_euler, Method::verlet, Method::rk4})
    for (const double h : {0.012, 0.016, 0.05, 0.5}) {
      SCOPED_TRACE(testing::Message() << name(method) << ", h = " << h);
      Solver solver(structure, forces, {.method = method, .step = h}, shaken_state(structure, 0.001, 0.1));
      Step bare(forces, method, {}, nullptr);
      State state = shaken_state(structure, 0.001, 0.1);
      long over = 0;
      bool diverged = false;
      for (long k = 1; k <= 4000 && !diverged; ++k) {
        bare(state, h);
        if (!over && largest_strain(structure, state) > SolverOptions{}.max_strain) over = k;
        try {
          solver.advance();
          ASSERT_TRUE(solver.state().position.allFinite() && solver.state().velocity.allFinite());
        } catch (const DivergenceError&) {
          diverged = true;
          ASSERT_GT(over, 0) << "nothing was wrong yet at step " << k;
          EXPECT_LE(k - over, 16);
        }
      }
      EXPECT_EQ(diverged, over > 0);
      EXPECT_TRUE(diverged || h < 0.016);
    }
}

TEST(Divergence, IsExplainedByStepParticleSpringAndLimit) {
  const Structure structure = merge({test::ring(5, 1.0, 1.0), sheet()});
  const Forces forces(structure, {0.0, -9.81, 0.0});
  const auto message = [&](SolverOptions options) -> std::string {
    Solver solver(structure, forces, options, shaken_state(structure, 0.001, 0.1));
    try {
      for (int k = 0; k < 1000; ++k) solver.advance();
    } catch (const DivergenceError& error) {
      return error.what();
    }
    return "";
  };
  const std::string plain = message({.step = 0.05, .limit = 0.0123});
  for (const char* part : {"diverged at step ", "(t = 0.", "particle ", " of 'drape' is the fastest", " spring ",
                           "times its rest length", "0.05 s", "limit for fb_euler is 0.0123 s", "step: auto"})
    EXPECT_THAT(plain, HasSubstr(part));
  EXPECT_THAT(message({.filter = FilterOptions{}, .step = 0.05, .limit = 0.0123}),
              HasSubstr("limit for fb_euler with this filter is 0.0123 s"));
  EXPECT_THAT(message({.step = 0.05}), HasSubstr("fb_euler has no known limit"));
}

TEST(Divergence, IsNotSuspectedOfASheetThatMerelyFliesFast) {
  const Structure structure = grid({.width = 4, .height = 4, .spacing = 0.1});
  const Forces forces(structure, Eigen::Vector3d::Zero());
  State start = rest_state(structure);
  start.velocity.col(2).setConstant(1e6);
  Solver solver(structure, forces, {.step = 0.01}, start);
  EXPECT_NO_THROW(solver.sample(1.0));
}

TEST(Divergence, ByCreepIsFoundWithoutSpeed) {
  Structure structure = sheet();
  structure.stiffness.setZero();
  structure.body[0].friction = 1.0;
  const Forces forces(structure, {0.0, -9.81, 0.0});
  Solver solver(structure, forces, {.step = 0.001}, rest_state(structure));
  EXPECT_THROW(solver.sample(100.0), DivergenceError);
  EXPECT_LT(largest_strain(structure, solver.state()), 11.0);
}

}  // namespace
}  // namespace billow::sim
