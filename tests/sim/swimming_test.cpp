// What the fish does in water: it swims by its own undulation, straight or turning, and only the water moves it.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/error.h"
#include "sim/muscle_force.h"
#include "sim/random.h"
#include "sim/water_force.h"
#include "tests/support/swimmers.h"

namespace billow {
namespace {

using test::Swimmer;

sim::State shaken(const sim::Structure& fish, double time, std::uint64_t seed) {
  sim::State state = sim::rest_state(fish);
  state.position += 0.01 * sim::seeded_noise(fish.particles(), seed);
  state.velocity = 0.3 * sim::seeded_noise(fish.particles(), seed + 1);
  state.time = time;
  return state;
}

TEST(Swimming, ComesTwoLengthsInTenSecondsFromRest) {
  const Swimmer fish(test::swimming());
  EXPECT_GT(fish.way(fish.at(10.0)).x(), 2.0);
}

TEST(Swimming, StaysAtRestWithoutMuscles) {
  const Swimmer fish(sim::MotionOptions{});
  const sim::State end = fish.at(10.0);
  EXPECT_LT((end.position - fish.structure.rest_position).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Swimming, GoesStraightWhenBothSidesWorkAlike) {
  const Swimmer fish(test::swimming());
  const Eigen::Vector3d way = fish.way(fish.at(10.0));
  EXPECT_LT(std::abs(way.z()), 0.12 * way.x());
  EXPECT_LT(std::abs(way.y()), 0.01 * way.x());
}

TEST(Swimming, IsFasterWithFasterBeatsUpToAPoint) {
  double last = 0.0;
  for (const double frequency : {0.2, 0.6, 1.2}) {
    const Swimmer fish(test::swimming(frequency, 0.35));
    const double way = fish.way(fish.at(10.0)).x();
    EXPECT_GT(way, last + 0.1) << frequency;
    last = way;
  }
  const Swimmer frantic(test::swimming(2.5, 0.35));
  EXPECT_LT(frantic.way(frantic.at(10.0)).x(), 0.5 * last);
}

TEST(Swimming, IsMirroredByTheOppositeBeat) {
  sim::MotionOptions opposite = test::swimming();
  opposite.phase = 3.14159265358979323846;
  const Swimmer one(test::swimming()), other(opposite);
  const Eigen::Vector3d a = one.way(one.at(3.0)), b = other.way(other.at(3.0));
  EXPECT_NEAR(a.x(), b.x(), 1e-6);
  EXPECT_NEAR(a.z(), -b.z(), 1e-6);
}

TEST(Swimming, TurnsToTheSideThatContracts) {
  for (const double turn : {0.4, -0.4}) {
    const Swimmer fish(test::turning(turn));
    const Eigen::Vector3d heading = fish.heading(fish.at(8.0));
    const double left = std::atan2(-heading.z(), heading.x());
    EXPECT_GT(left * (turn > 0.0 ? 1.0 : -1.0), 0.3) << turn;
  }
}

TEST(Swimming, LooksAlikeExplicitFilteredAndImplicit) {
  const Swimmer fish(test::swimming());
  sim::SolverOptions options;
  options.step = 0.05;
  const auto snout = [&](const sim::SolverOptions& o) -> Eigen::RowVector3d {
    return fish.at(6.0, o).position.row(sim::fish_snout());
  };
  const Eigen::RowVector3d reference = snout(options);
  sim::SolverOptions filtered = options;
  filtered.filter.emplace();
  filtered.filter->lambda = 4.0;
  filtered.filter->form = sim::FilterForm::symmetric;
  sim::SolverOptions implicit = options;
  implicit.method = sim::Method::backward_euler;
  implicit.step = 0.01;
  EXPECT_LT((snout(filtered) - reference).norm(), 0.35);
  EXPECT_LT((snout(implicit) - reference).norm(), 0.35);
}

TEST(MuscleForce, SumsToNothing) {
  const sim::Structure fish = sim::build_fish(test::swimmer_options());
  const sim::MuscleForce muscles(fish, 0, sim::FishMotion(test::swimming()));
  const sim::State state = shaken(fish, 1.3, 7);
  Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(fish.particles(), 3);
  muscles.add_force(state, force);
  EXPECT_GT(force.norm(), 0.1);
  EXPECT_LT(force.colwise().sum().norm(), 1e-12);
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  for (int i = 0; i < fish.particles(); ++i) {
    const Eigen::Vector3d x = state.position.row(i), f = force.row(i);
    torque += x.cross(f);
  }
  EXPECT_LT(torque.norm(), 1e-12);
}

TEST(MuscleForce, IsTheSlopeOfItsEnergy) {
  const sim::Structure fish = sim::build_fish(test::swimmer_options());
  const sim::MuscleForce muscles(fish, 0, sim::FishMotion(test::turning(0.3)));
  sim::State state = shaken(fish, 3.4, 11);
  Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(fish.particles(), 3);
  muscles.add_force(state, force);
  constexpr double d = 1e-6;
  for (int i = 0; i < fish.particles(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double x = state.position(i, axis);
      state.position(i, axis) = x + d;
      const double above = muscles.energy(state);
      state.position(i, axis) = x - d;
      const double below = muscles.energy(state);
      state.position(i, axis) = x;
      EXPECT_NEAR(force(i, axis), -(above - below) / (2.0 * d), 1e-7);
    }
}

// Whatever the shape and the motion, what moves the fish as a whole is the water.
TEST(WaterForce, IsTheTotalForceOnTheFish) {
  const Swimmer fish(test::swimming());
  const sim::WaterForce water({580.0, Eigen::Vector3d::Zero()}, sim::fish_faces(), 0);
  const sim::State state = shaken(fish.structure, 2.2, 3);
  Eigen::MatrixX3d all, pressure = Eigen::MatrixX3d::Zero(fish.structure.particles(), 3);
  fish.forces->evaluate(state, all);
  water.add_force(state, pressure);
  EXPECT_GT(pressure.colwise().sum().norm(), 0.1);
  EXPECT_LT((all - pressure).colwise().sum().norm(), 1e-10);
}

TEST(WaterForce, OnlyTakesEnergyFromABodyInStillWater) {
  const sim::Structure fish = sim::build_fish(test::swimmer_options());
  const sim::WaterForce water({580.0, Eigen::Vector3d::Zero()}, sim::fish_faces(), 0);
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const sim::State state = shaken(fish, 0.0, 2 * seed);
    Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(fish.particles(), 3);
    water.add_force(state, force);
    EXPECT_LE(force.cwiseProduct(state.velocity).sum(), 0.0);
  }
}

TEST(WaterForce, VanishesForABodyThatDriftsWithTheCurrent) {
  const sim::Structure fish = sim::build_fish(test::swimmer_options());
  const Eigen::Vector3d current(0.3, -0.1, 0.2);
  const sim::WaterForce water({580.0, current}, sim::fish_faces(), 0);
  sim::State state = sim::rest_state(fish);
  state.velocity.rowwise() = current.transpose();
  Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(fish.particles(), 3);
  water.add_force(state, force);
  EXPECT_LT(force.norm(), 1e-12);
}

TEST(Buoyancy, CarriesTheWeight) {
  const sim::Structure fish = sim::build_fish({});
  const Eigen::Vector3d gravity(0.0, -9.81, 0.0);
  sim::Forces forces(fish, gravity);
  forces.add(std::make_unique<sim::Buoyancy>(fish, 0, gravity, 1.0));
  Eigen::MatrixX3d force;
  forces.evaluate(sim::rest_state(fish), force);
  EXPECT_LT(force.norm(), 1e-10);
}

TEST(FishMotion, ContractsTheSidesInTurnAndTheLastSegmentLater) {
  const sim::FishMotion motion(test::swimming(1.0, 0.6));
  for (const double t : {1.0, 1.15, 1.4, 2.7}) {
    const double left = motion.contraction(1, sim::Side::left, t), right = motion.contraction(1, sim::Side::right, t);
    EXPECT_NEAR(left + right, 0.6, 1e-12);
    EXPECT_EQ(motion.contraction(0, sim::Side::left, t), 0.0);
    EXPECT_NEAR(motion.contraction(2, sim::Side::left, t + 93.0 / 360.0), left, 1e-12);
  }
}

TEST(FishMotion, NeverJumpsWhenKeysChange) {
  sim::MotionOptions options = test::swimming(1.0, 0.6);
  options.keys.push_back({2.0, 0.2, 0.5, 2.0});
  options.keys.push_back({3.0, 0.0, 0.0, 0.7});
  const sim::FishMotion motion(options);
  for (int segment = 0; segment < sim::fish_segments; ++segment)
    for (double t = 0.0; t < 5.0; t += 1e-3)
      EXPECT_LT(std::abs(motion.contraction(segment, sim::Side::left, t + 1e-3) -
                         motion.contraction(segment, sim::Side::left, t)),
                0.01);
}

TEST(FishMotion, RefusesKeysNearerThanTheTransition) {
  sim::MotionOptions options = test::swimming();
  options.keys.push_back({0.1, 0.0, 0.0, 1.0});
  EXPECT_THROW(sim::FishMotion{options}, InputError);
}

}  // namespace
}  // namespace billow
