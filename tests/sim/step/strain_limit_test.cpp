// Springs stay within their limit, momenta stay what they were, and energy is only lost.
#include "sim/step/strain_limit.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <numeric>

#include "sim/body/momenta.h"
#include "sim/step/solver.h"
#include "sim/step/watched_run.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

const Eigen::Vector3d gravity{0.0, -9.81, 0.0};

/// Two free masses of 1 and 3 kg on a spring of 1 m.
Structure pair() {
  Structure structure = test::oscillator(1.0, 0.0);
  structure.mass << 1.0, 3.0;
  structure.inverse_mass = structure.mass.cwiseInverse();
  return structure;
}

/// The state with the velocities that a limit makes of its own in a step of h.
State limited(StrainLimit& limit, State state, double h) {
  Eigen::MatrixX3d velocity = state.velocity;
  limit.begin(state, h);
  limit.apply(state, {.by_new = h}, velocity);
  state.velocity = velocity;
  return state;
}

double length_after(const State& state, double h) {
  return (state.position.row(1) - state.position.row(0) + h * (state.velocity.row(1) - state.velocity.row(0))).norm();
}

/// The largest strain of the springs that are limited.
double largest_strain(const Structure& structure, const State& state) {
  double most = -1.0;
  for (int s = 0; s < structure.springs(); ++s) {
    if (structure.kind[s] == SpringKind::bend) continue;
    const auto apart = state.position.row(structure.spring(s, 1)) - state.position.row(structure.spring(s, 0));
    most = std::max(most, apart.norm() / structure.rest_length(s) - 1.0);
  }
  return most;
}

HookMaker limits(const Structure& structure, double limit) {
  return [&structure, limit] { return std::make_unique<StrainLimit>(structure, std::vector<double>{limit}); };
}

// Going apart at 2 m/s with 0.1 m of room, in 0.1 s: 1 m/s is left, taken off by one impulse of the reduced mass.
TEST(StrainLimit, LeavesTwoMassesAsFastAsTheirSpringHasRoom) {
  const Structure structure = pair();
  State state = rest_state(structure);
  state.velocity << -0.5, 0.0, 0.2, 1.5, 0.0, 0.2;
  StrainLimit limit(structure, {0.1});
  const State after = limited(limit, state, 0.1);
  const double impulse = 0.75 * (2.0 - 1.0);
  EXPECT_NEAR(after.velocity(0, 0), -0.5 + impulse, 1e-14);
  EXPECT_NEAR(after.velocity(1, 0), 1.5 - impulse / 3.0, 1e-14);
  EXPECT_EQ(after.velocity.col(2), state.velocity.col(2));
  EXPECT_NEAR(length_after(after, 0.1), 1.1, 1e-14);
  EXPECT_EQ(limit.work(), 0.0);
}

// At its limit and turning: a chord of the circle, at the end of which it goes apart as fast as it came together.
TEST(StrainLimit, TurnsASpringRoundItsCircleWithoutLoss) {
  const Structure structure = pair();
  State state = rest_state(structure);
  state.position(1, 0) = 1.1;
  state.velocity.row(1) << 0.05, 1.0, 0.0;
  StrainLimit limit(structure, {0.1});
  const double h = 0.05;
  const double chord = (std::sqrt(1.1 * 1.1 - h * h) - 1.1) / h;
  const State first = limited(limit, state, h);
  EXPECT_NEAR(first.velocity(1, 0) - first.velocity(0, 0), chord, 1e-14);
  State turning = first;
  for (int step = 0; step < 200; ++step) {
    move(turning, h);
    turning = limited(limit, turning, h);
    EXPECT_NEAR(length_after(turning, h), 1.1, 1e-12) << step;
  }
  EXPECT_NEAR(kinetic_energy(structure, turning), kinetic_energy(structure, first), 1e-12);
}

// A fifth of the way a step, but at most a two hundredth of the length; that puts energy in, and says so.
TEST(StrainLimit, BringsBackWhatIsTooLongAndCountsIt) {
  const Structure structure = pair();
  StrainLimit limit(structure, {0.1});
  const double h = 0.01;
  for (const auto& [length, back] : {std::pair{1.11, 0.2 * 0.01}, {2.0, 0.005 * 1.1}}) {
    State state = rest_state(structure);
    state.position(1, 0) = length;
    limit.forget();
    const State after = limited(limit, state, h);
    EXPECT_NEAR(length_after(after, h), length - back, 1e-14);
    EXPECT_NEAR(limit.work(), 2.0 * kinetic_energy(structure, after), 1e-12)
        << "impulse / h over the whole way: twice its mean";
  }
}

TEST(StrainLimit, ChangesNoBitWhereNothingIsTooLong) {
  const Structure structure = test::light_cloth(9, 7, {0, 8});
  const State state = test::shaken_state(structure, 0.003, 0.5);
  ASSERT_LT(largest_strain(structure, state), 0.08);
  StrainLimit limit(structure, {0.1});
  const State after = limited(limit, state, 1e-3);
  EXPECT_EQ(after.velocity, state.velocity);
  EXPECT_EQ(limit.iterations(), 0);
}

TEST(StrainLimit, LeavesOtherBodiesAndBendSpringsAlone) {
  const Structure cloth = test::light_cloth(5, 5);
  const Structure both = merge({cloth, cloth});
  State state = rest_state(both);
  for (int i = 0; i < both.particles(); ++i) state.velocity(i, 0) = 50.0 * state.position(i, 0);
  StrainLimit limit(both, {INFINITY, 0.1});
  const State after = limited(limit, state, 0.01);
  const int n = cloth.particles();
  EXPECT_EQ(after.velocity.topRows(n), state.velocity.topRows(n));
  EXPECT_NE(after.velocity.bottomRows(n), state.velocity.bottomRows(n));

  Structure bends = test::light_cloth(3, 1);
  for (SpringKind& kind : bends.kind) kind = SpringKind::bend;
  State stretched = rest_state(bends);
  stretched.position *= 2.0;
  StrainLimit none(bends, {0.1});
  EXPECT_EQ(limited(none, stretched, 0.01).velocity, stretched.velocity);
}

class StrainLimitOfAClothTornApart : public testing::Test {
 protected:
  const Structure structure_ = test::with_uneven_masses(test::light_cloth(12, 11), 0.5);
  // Every particle at up to 3 m/s: 3 cm a step where springs have 1 cm of room.
  State torn(double distance) const { return test::shaken_state(structure_, distance, 3.0); }
};

TEST_F(StrainLimitOfAClothTornApart, KeepsLinearAndAngularMomentum) {
  for (const double distance : {0.001, 0.03}) {
    StrainLimit limit(structure_, {0.1});
    State state = torn(distance);
    const Eigen::Vector3d linear = linear_momentum(structure_, state), angular = angular_momentum(structure_, state);
    for (int step = 0; step < 20; ++step) {
      state = limited(limit, state, 0.01);
      EXPECT_GT(limit.iterations(), 0);
      move(state, 0.01);
      EXPECT_LT((linear_momentum(structure_, state) - linear).norm(), 1e-12);
      EXPECT_LT((angular_momentum(structure_, state) - angular).norm(), 1e-12);
    }
  }
}

TEST_F(StrainLimitOfAClothTornApart, OnlyLosesEnergyFromWithinTheLimit) {
  for (int seed = 1; seed <= 20; ++seed) {
    const State state = test::shaken_state(structure_, 0.003, 3.0, static_cast<std::uint64_t>(seed));
    ASSERT_LT(largest_strain(structure_, state), 0.1);
    StrainLimit limit(structure_, {0.1});
    const State after = limited(limit, state, 0.01);
    EXPECT_LT(kinetic_energy(structure_, after), kinetic_energy(structure_, state));
    EXPECT_EQ(limit.work(), 0.0);
    // Also with forces that have nothing to do with this state: those of the last.
    const State other = test::shaken_state(structure_, 0.003, 3.0, static_cast<std::uint64_t>(seed) + 100);
    EXPECT_LE(kinetic_energy(structure_, limited(limit, other, 0.01)), kinetic_energy(structure_, other));
  }
}

TEST_F(StrainLimitOfAClothTornApart, LeavesNoSpringMuchTooLong) {
  StrainLimit limit(structure_, {0.1});
  State state = test::shaken_state(structure_, 0.003, 1.0);
  State free = state;
  move(free, 0.01);
  ASSERT_GT(largest_strain(structure_, free), 0.2);
  state = limited(limit, state, 0.01);
  move(state, 0.01);
  EXPECT_LT(largest_strain(structure_, state), 0.11) << "of which turning has the most";
}

TEST(StrainLimit, KeepsThePaceOfPinsAndCountsTheirWork) {
  const Structure structure = test::fixed_chain({.free_particles = 3, .second_wall = false});
  State state = rest_state(structure);
  state.position.col(0) *= 1.1;
  state.velocity(0, 0) = -2.0;  // moved away from the others
  StrainLimit limit(structure, {0.1});
  const State after = limited(limit, state, 0.01);
  EXPECT_EQ(after.velocity.row(0), state.velocity.row(0));
  for (int i = 1; i <= 3; ++i) EXPECT_NEAR(after.velocity(i, 0), -2.0, 0.01) << i;
  // An inelastic jerk: 3 kg at 2 m/s are 6 N s at 2 m/s, half of which is lost.
  EXPECT_NEAR(limit.work(), 12.0, 0.06);
}

/// The largest strain that a run comes to within a time [s], and what it has at its end.
struct Strains {
  double most = 0.0, end = 0.0;
};
Strains run(const Structure& structure, const Eigen::Vector3d& force, Method method, double step, double time) {
  const Forces forces(structure, force);
  Solver solver(structure, forces, {.method = method, .hooks = {limits(structure, 0.1)}, .step = step},
                rest_state(structure));
  Strains strains;
  while (solver.state().time < time) {
    solver.advance();
    strains.end = largest_strain(structure, solver.state());
    strains.most = std::max(strains.most, strains.end);
  }
  return strains;
}

// Forty links dropped from rest; without a limit the first stretches to twice its length.
TEST(StrainLimit, HoldsAFallingChain) {
  const Structure chain = test::fixed_chain(
      {.free_particles = 40, .mass = 0.0025, .stiffness = 40.0, .rest_length = 0.025, .second_wall = false});
  const double step = 0.9 / std::sqrt(40.0 / 0.0025);
  for (const Method method : {Method::fb_euler, Method::verlet, Method::imex}) {
    const Strains strains = run(chain, {9.81, 0.0, 0.0}, method, step, 2.0);
    EXPECT_LT(strains.most, 0.11) << name(method);
    EXPECT_LT(strains.end, 0.105) << name(method);
  }
}

// A sheet that hangs by its upper row, whose springs would be four times as long without a limit.
TEST(StrainLimit, HoldsAHangingSheet) {
  const int width = 15;
  std::vector<int> row(width);
  std::iota(row.begin(), row.end(), 0);
  const Structure sheet = test::grid({.width = width,
                                      .height = 15,
                                      .spacing = 0.05,
                                      .mass = 0.005,
                                      .structural = 5.0,
                                      .shear = 3.5,
                                      .bend = 1.5,
                                      .pinned = row});
  const Strains strains = run(sheet, {0.0, 0.0, 9.81}, Method::fb_euler, 5e-3, 3.0);
  EXPECT_LT(strains.most, 0.11);
  EXPECT_LT(strains.end, 0.105);
  EXPECT_GT(strains.end, 0.095) << "the limit must be what holds it";
}

// The watch sees no energy from nowhere, and its tally stays small.
TEST(StrainLimit, LeavesAWatchedRunInPeace) {
  const Structure sheet = test::light_cloth(10, 10, {0, 9});
  const Forces forces(sheet, gravity);
  auto solver = std::make_unique<Solver>(
      sheet, forces, SolverOptions{.hooks = {limits(sheet, 0.05)}, .step = 2e-3, .max_strain = torn_strain},
      rest_state(sheet));
  double time = 0.0;
  WatchedRun watched(sheet, forces, std::move(solver), {.energy_scale = 1.0 * 9.81, .stretch = 16},
                     [&] { return time < 3.0 ? time += 0.1 : INFINITY; });
  while (const auto sample = watched.next()) EXPECT_LT(largest_strain(sheet, sample->state), 0.08) << sample->time;
  EXPECT_TRUE(watched.incidents().empty());
}

// Enough springs for several parts of the pass.
TEST(StrainLimit, HasTheSameBitsOnOneThreadAndOnTwo) {
  const Structure sheet = test::light_cloth(110, 110, {0, 109});
  State end[2];
  for (const int threads : {1, 2}) {
    oneapi::tbb::task_arena arena(threads);
    arena.execute([&] {
      StrainLimit limit(sheet, {0.02});
      State state = test::shaken_state(sheet, 0.002, 0.5);
      for (int step = 0; step < 3; ++step) {
        state = limited(limit, state, 4e-3);
        EXPECT_GT(limit.iterations(), 0);
        move(state, 4e-3);
      }
      end[threads - 1] = state;
    });
  }
  EXPECT_EQ(end[0].position, end[1].position);
  EXPECT_EQ(end[0].velocity, end[1].velocity);
}

// Numbered otherwise, the same sheet has no rows: the limit finds the same springs.
TEST(StrainLimit, FindsTheSameSpringsInAnyNumbering) {
  Structure sheet = test::light_cloth(12, 12);
  State state = rest_state(sheet);
  state.position *= 1.12;
  StrainLimit by_rows(sheet, {0.1});
  const State expected = limited(by_rows, state, 0.01);
  const int n = sheet.particles();
  const auto number = [n](int i) { return i * 7 % n; };  // 7 and 144 have no common factor
  State renumbered = state;
  for (int i = 0; i < n; ++i) renumbered.position.row(number(i)) = state.position.row(i);
  for (int s = 0; s < sheet.springs(); ++s) {
    const int i = number(sheet.spring(s, 0)), j = number(sheet.spring(s, 1));
    sheet.spring.row(s) << std::min(i, j), std::max(i, j);
  }
  StrainLimit scattered(sheet, {0.1});
  const State found = limited(scattered, renumbered, 0.01);
  for (int i = 0; i < n; ++i)
    EXPECT_LT((found.velocity.row(number(i)) - expected.velocity.row(i)).norm(), 0.05 * expected.velocity.norm());
}

}  // namespace
}  // namespace billow::sim
