// What the fish does in water: it swims by its own undulation, straight or turning, and only the water moves it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "sim/force/buoyancy.h"
#include "sim/force/muscle_force.h"
#include "sim/force/water_force.h"
#include "tests/support/evaluations.h"
#include "tests/support/swimmers.h"

namespace billow {
namespace {

using test::Swimmer;

sim::State shaken(const sim::Structure& fish, double time, std::uint64_t seed) {
  sim::State state = sim::rest_state(fish);
  state.position += 0.01 * seeded_noise(fish.particles(), seed);
  state.velocity = 0.3 * seeded_noise(fish.particles(), seed + 1);
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
  const sim::State state = shaken(fish, 3.4, 11);
  const Eigen::MatrixX3d slope =
      test::minus_gradient([&](const sim::State& at) { return muscles.energy(at); }, state, 1e-6);
  EXPECT_LT((test::force_of(muscles, state) - slope).norm(), 1e-7);
}

// Together with the springs that they are, muscles hold 1/2 k (l - L (1 - c))^2.
TEST(MuscleForce, HasTheEnergyThatItsSpringsLackWhenTheyAreShorter) {
  const sim::Structure fish = sim::build_fish(test::swimmer_options());
  const sim::FishMotion motion(test::turning(0.3));
  const sim::MuscleForce muscles(fish, 0, motion);
  const sim::State state = shaken(fish, 3.4, 11);
  double contracted = 0.0, at_rest_length = 0.0;
  for (const sim::Muscle& muscle : sim::fish_muscles()) {
    const int s = muscle.spring;
    const double length = (state.position.row(fish.spring(s, 1)) - state.position.row(fish.spring(s, 0))).norm();
    const double shorter = fish.rest_length(s) * (1.0 - motion.contraction(muscle.segment, muscle.side, state.time));
    contracted += 0.5 * fish.stiffness(s) * std::pow(length - shorter, 2);
    at_rest_length += 0.5 * fish.stiffness(s) * std::pow(length - fish.rest_length(s), 2);
  }
  EXPECT_GT(contracted, 2.0 * at_rest_length) << "the test must be able to tell";
  EXPECT_NEAR(muscles.energy(state), contracted - at_rest_length, 1e-12 * contracted);
}

// Whatever the shape and the motion, what moves the fish as a whole is the water.
TEST(WaterForce, IsTheTotalForceOnTheFish) {
  const Swimmer fish(test::swimming());
  const sim::WaterForce water(fish.structure, {580.0, Eigen::Vector3d::Zero()}, sim::fish_faces(), 0);
  const sim::State state = shaken(fish.structure, 2.2, 3);
  const Eigen::MatrixX3d all = test::force_of(*fish.forces, state);
  Eigen::MatrixX3d pressure = Eigen::MatrixX3d::Zero(fish.structure.particles(), 3);
  water.add_force(state, pressure);
  EXPECT_GT(pressure.colwise().sum().norm(), 0.1);
  EXPECT_LT((all - pressure).colwise().sum().norm(), 1e-10);
}

TEST(WaterForce, OnlyTakesEnergyFromABodyInStillWater) {
  const sim::Structure fish = sim::build_fish(test::swimmer_options());
  const sim::WaterForce water(fish, {580.0, Eigen::Vector3d::Zero()}, sim::fish_faces(), 0);
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const sim::State state = shaken(fish, 0.0, 2 * seed);
    const Eigen::MatrixX3d force = test::force_of(water, state);
    const double power = force.cwiseProduct(state.velocity).sum();
    EXPECT_LT(power, -0.01 * force.norm() * state.velocity.norm());
    EXPECT_GT(force.norm(), 0.1) << "some face always moves into the water";
  }
}

TEST(WaterForce, VanishesForABodyThatDriftsWithTheCurrent) {
  const sim::Structure fish = sim::build_fish(test::swimmer_options());
  const Eigen::Vector3d current(0.3, -0.1, 0.2);
  const sim::WaterForce water(fish, {580.0, current}, sim::fish_faces(), 0);
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
  const Eigen::MatrixX3d force = test::force_of(forces, sim::rest_state(fish));
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

/// What the muscles of both sides do at most, by time.
double most_contracted(const sim::FishMotion& motion, int segment, sim::Side side) {
  double most = 0.0;
  for (double t = 0.0; t < 8.0; t += 1e-3) {
    const double contraction = motion.contraction(segment, side, t);
    EXPECT_GE(contraction, 0.0);
    most = std::max(most, contraction);
  }
  return most;
}

std::vector<sim::MotionOptions> motions() {
  sim::MotionOptions both = test::swimming(1.0, 0.4), changing = both;
  both.keys[0].turn = 0.3;
  changing.keys.push_back({2.0, 0.8, -0.1, 2.0});
  changing.keys.push_back({4.0, 0.2, 0.5, 0.7});
  return {{}, test::swimming(), both, changing};
}

// What the step limit is found for is what the muscles do: no less, or it does not hold; no more, or it costs steps.
TEST(FishMotion, ReachesItsLargestContractionAndNeverMore) {
  for (const sim::MotionOptions& options : motions()) {
    const sim::FishMotion motion(options);
    for (int segment = 0; segment < sim::fish_segments; ++segment)
      for (const sim::Side side : {sim::Side::left, sim::Side::right}) {
        const double largest = motion.largest_contraction(segment, side);
        EXPECT_LE(most_contracted(motion, segment, side), largest);
        EXPECT_GT(most_contracted(motion, segment, side), largest - 1e-4);
      }
  }
}

// Swimming and turning at once ask for more than a muscle's whole length.
TEST(FishMotion, NeverContractsAMuscleByMoreThanItsLength) {
  sim::MotionOptions options = test::swimming(1.0, 0.9);
  options.keys[0].turn = 0.8;
  const sim::FishMotion motion(options);
  EXPECT_EQ(motion.largest_contraction(1, sim::Side::left), 1.0);
  EXPECT_EQ(most_contracted(motion, 1, sim::Side::left), 1.0);
  EXPECT_NEAR(most_contracted(motion, 1, sim::Side::right), 0.9, 1e-4) << "which only swims";
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
