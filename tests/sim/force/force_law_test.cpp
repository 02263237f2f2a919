// Every law of force against what it says of itself: energy, Jacobians and passivity, in one table for all.
#include "sim/force/force_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "base/random.h"
#include "sim/body/fish.h"
#include "sim/force/buoyancy.h"
#include "sim/force/muscle_force.h"
#include "sim/force/water_force.h"
#include "sim/force/wind_force.h"
#include "tests/support/evaluations.h"
#include "tests/support/laws.h"
#include "tests/support/step_matrix.h"
#include "tests/support/swimmers.h"

namespace billow::sim {
namespace {

using namespace test::laws;

Eigen::MatrixX3d minus_energy_gradient(const ForceLaw& law, const State& state, double d) {
  return test::minus_gradient([&](const State& at) { return law.energy(at); }, state, d);
}

Eigen::MatrixXd minus_slope(const ForceLaw& law, const State& state, Eigen::MatrixX3d State::*field, double d) {
  return test::minus_slope([&](const State& at) { return test::force_of(law, at); }, state, field, d);
}

/// x + share v, as time goes on.
State moved(State state, double share) {
  state.position += share * state.velocity;
  state.time += share;
  return state;
}

// Nothing moves: what is left of a force is that of its potential. A current or a wind pushes all the same.
TEST(EveryLaw, PullsDownItsPotentialEnergy) {
  for_every_law([](const Case& c) {
    if (c.stream) return;
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      State state = shaken(*c.structure, seed);
      state.velocity.setZero();
      const Eigen::MatrixX3d force = test::force_of(*c.law, state);
      EXPECT_LE((force - minus_energy_gradient(*c.law, state, 1e-6)).norm(), 1e-6 * force.norm());
    }
  });
}

// How damping and pressure turn with what they act along included: the exact form is the whole of it.
TEST(EveryLaw, LinearisesExactlyToMinusTheSlopeOfItsForce) {
  for_every_law([](const Case& c) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const State state = shaken(*c.structure, seed);
      const Eigen::MatrixXd by_position = minus_slope(*c.law, state, &State::position, 1e-6);
      const Eigen::MatrixXd by_velocity = minus_slope(*c.law, state, &State::velocity, 1e-6);
      EXPECT_LE((stiffness(c, state, JacobianForm::exact) - by_position).norm(), 1e-6 * by_position.norm());
      EXPECT_LE((damping(c, state, JacobianForm::exact) - by_velocity).norm(), 1e-7 * by_velocity.norm());
      const Eigen::MatrixXd both = 0.3 * by_position + 0.02 * by_velocity;
      EXPECT_LE((linearised(c, state, 0.3, 0.02, JacobianForm::exact) - both).norm(), 1e-6 * both.norm());
    }
  });
}

// Pulled apart and pushed together: what may be dropped from K is dropped only there, and nothing from C.
TEST(EveryLaw, HasADefiniteFormThatIsSymmetricWithoutANegativeEigenvalue) {
  for_every_law([](const Case& c) {
    for (const double size : {0.3, 1.7}) {
      State state = shaken(*c.structure, 4);
      state.position *= size;
      for (const auto& [k, d] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {0.1, 2.0}}) {
        const Eigen::MatrixXd definite = linearised(c, state, k, d, JacobianForm::definite);
        EXPECT_LE((definite - definite.transpose()).norm(), 1e-14 * definite.norm());
        EXPECT_GE(test::least_eigenvalue(definite), -1e-12 * definite.norm());
      }
      EXPECT_EQ(damping(c, state, JacobianForm::definite), damping(c, state, JacobianForm::exact));
    }
  });
}

/// Force times velocity [W] plus how fast the law's own potential energy grows, over the scale of the first.
double relative_power(const Case& c, const State& state) {
  constexpr double d = 1e-6;
  const Eigen::MatrixX3d force = test::force_of(*c.law, state);
  const double stored = (c.law->energy(moved(state, d)) - c.law->energy(moved(state, -d))) / (2.0 * d);
  const double scale = force.norm() * state.velocity.norm();
  return scale > 0.0 ? (force.cwiseProduct(state.velocity).sum() + stored) / scale : 0.0;
}

TEST(EveryLaw, TakesEnergyOrKeepsItWhereItSaysThatItIsPassiveAndElseGivesSome) {
  for_every_law([](const Case& c) {
    EXPECT_EQ(c.law->passive(), c.power != Power::gives);
    double least = 0.0, most = -1.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const double power = relative_power(c, shaken(*c.structure, seed));
      least = std::min(least, power), most = std::max(most, power);
    }
    if (c.power == Power::gives)
      EXPECT_GT(most, 1e-3);
    else if (c.power == Power::takes)
      EXPECT_LT(most, -1e-3);
    else
      EXPECT_LT(std::max(most, -least), 1e-7);
  });
}

// The work is what the power over a short while comes to, the change of its own potential energy and what it takes from
// the motion apart: for muscles all of it, for a current or a wind its push times its own velocity.
TEST(EveryLaw, PutsInTheWorkThatItSays) {
  for_every_law([](const Case& c) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const State before = shaken(*c.structure, seed);
      constexpr double h = 1e-5;
      const State after = moved(before, h);
      const double work = c.law->work(before, after);
      if (c.power != Power::gives) {
        EXPECT_EQ(work, 0.0);
        continue;
      }
      const Eigen::MatrixX3d force = 0.5 * (test::force_of(*c.law, before) + test::force_of(*c.law, after));
      const double scale = force.norm() * before.velocity.norm() * h;
      if (c.stream) {
        EXPECT_NEAR(work, h * force.colwise().sum().dot(c.stream->transpose()), 1e-8 * scale);
      } else {
        const double done = h * force.cwiseProduct(before.velocity).sum();
        EXPECT_NEAR(work, done + c.law->energy(after) - c.law->energy(before), 1e-4 * scale);
        EXPECT_GT(std::abs(work), 0.0);
      }
    }
  });
}

TEST(EveryLaw, DampsAtLeastAsMuchAsItSaysAtAnyShape) {
  for_every_law([](const Case& c) {
    StiffnessMatrix least(*c.structure);
    c.law->add_least_damping(least);
    const Eigen::MatrixXd dense(least.assemble(false));
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const Eigen::MatrixXd excess = damping(c, shaken(*c.structure, seed, 0.2), JacobianForm::definite) - dense;
      EXPECT_GE(test::least_eigenvalue(excess), -1e-9 * (1.0 + dense.norm()));
    }
  });
}

// Whichever place its body has in the whole, a law of one body does to it what it would do alone, and nothing to
// others.
TEST(LawOfABody, ActsOnItAsIfItWereAlone) {
  const Structure alone = build_fish(test::swimmer_options()), whole = ring_and_fish();
  const FishMotion motion(test::turning(0.4));
  const Water water{resistance, current};
  const Wind wind{.velocity = current, .gusts = Gusts{}};
  const auto pairs = {
      std::pair<std::shared_ptr<ForceLaw>, std::shared_ptr<ForceLaw>>{
          std::make_shared<MuscleForce>(alone, 0, motion), std::make_shared<MuscleForce>(whole, fish_body, motion)},
      {std::make_shared<WaterForce>(alone, water, fish_faces(), 0),
       std::make_shared<WaterForce>(whole, water, fish_faces(), first_fish_particle)},
      {std::make_shared<WindForce>(alone, wind, fish_faces(), 0),
       std::make_shared<WindForce>(whole, wind, fish_faces(), first_fish_particle)},
      {std::make_shared<Buoyancy>(alone, 0, gravity, 0.8), std::make_shared<Buoyancy>(whole, fish_body, gravity, 0.8)}};
  const State state = shaken(whole, 3);
  const int n = alone.particles();
  const State fish{state.position.bottomRows(n), state.velocity.bottomRows(n), state.time};
  for (const auto& [law, in_the_whole] : pairs) {
    SCOPED_TRACE(law->name());
    const Eigen::MatrixX3d force = test::force_of(*in_the_whole, state);
    EXPECT_TRUE(force.topRows(first_fish_particle).isZero(0.0));
    EXPECT_EQ(force.bottomRows(n), test::force_of(*law, fish));
    EXPECT_NEAR(in_the_whole->energy(state), law->energy(fish), 1e-12);
  }
}

TEST(EveryLaw, AddsToWhatIsThere) {
  for_every_law([](const Case& c) {
    const State state = shaken(*c.structure, 1);
    const Eigen::MatrixX3d before = seeded_noise(c.structure->particles(), 3), alone = test::force_of(*c.law, state);
    Eigen::MatrixX3d sum = before;
    c.law->add_force(state, sum);
    EXPECT_LE((sum - (before + alone)).norm(), 1e-14 * (before.norm() + alone.norm()));
  });
}

}  // namespace
}  // namespace billow::sim
