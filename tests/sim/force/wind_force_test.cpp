// The wind on a face against closed forms, its C against its bound, and its gusts.
#include "sim/force/wind_force.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "sim/force/forces.h"
#include "tests/support/evaluations.h"
#include "tests/support/laws.h"
#include "tests/support/step_matrix.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

constexpr double rho = 1.2, side_length = 0.5, area = side_length * side_length;

/// One square face in the xz-plane, normal along y.
struct Plate {
  Structure structure = test::grid({.width = 2, .height = 2, .spacing = side_length, .mass = 0.01});
  std::vector<Face> front = {{0, 2, 3, 1}}, back = {{1, 3, 2, 0}};

  State moving(const Eigen::Vector3d& velocity) const {
    State state = rest_state(structure);
    state.velocity.rowwise() = velocity.transpose();
    return state;
  }
  /// [N] of all four corners together.
  Eigen::Vector3d push(const Wind& wind, const State& state) const {
    return test::force_of(WindForce(structure, wind, front, 0), state).colwise().sum().transpose();
  }
  Eigen::Vector3d push(const Wind& wind) const { return push(wind, rest_state(structure)); }
  /// -dF/dv of the whole face, moved as one.
  Eigen::Matrix3d damping(const Wind& wind, const Eigen::Vector3d& velocity) const {
    StiffnessMatrix matrix(structure);
    WindForce(structure, wind, front, 0).add_linearisation(moving(velocity), 0.0, 1.0, JacobianForm::definite, matrix);
    return together(matrix);
  }
  Eigen::Matrix3d together(const StiffnessMatrix& matrix) const {
    const Eigen::MatrixXd dense(matrix.assemble(false));
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) sum += dense.block<3, 3>(3 * i, 3 * j);
    return sum;
  }
};

/// Of `speed`, at `degrees` from the plate's normal.
Eigen::Vector3d blowing(double speed, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return speed * Eigen::Vector3d(std::sin(angle), std::cos(angle), 0.0);
}

// drag 1/2 rho A v^2 (drag - 3/2 lift sin^2) with the wind, lift 1/2 rho A v^2 lift sin cos across it.
TEST(WindForce, IsDragAndLiftAtEveryAngle) {
  const Plate plate;
  const double pressure = 0.5 * rho * area * 36.0;
  for (const double degrees : {0.0, 20.0, 45.0, 70.0, 90.0, 130.0, 180.0, 250.0}) {
    SCOPED_TRACE(degrees);
    const Eigen::Vector3d wind = blowing(6.0, degrees), along = wind.normalized();
    const Eigen::Vector3d force = plate.push({.velocity = wind, .drag = 1.1, .lift = 0.5});
    const double c = along.y(), s = along.x();
    EXPECT_NEAR(force.dot(along), pressure * (1.1 - 1.5 * 0.5 * s * s), 1e-12 * pressure);
    EXPECT_NEAR(force.dot(Eigen::Vector3d(-c, s, 0.0)), pressure * 0.5 * s * c, 1e-12 * pressure);
    EXPECT_NEAR(force.z(), 0.0, 1e-12 * pressure);
  }
}

TEST(WindForce, IsPressureAloneSquareToTheWindAndFrictionAloneAlongIt) {
  const Plate plate;
  const double pressure = 0.5 * rho * area * 25.0;
  const Eigen::Vector3d square = plate.push({.velocity = {0, 5, 0}}), flat = plate.push({.velocity = {5, 0, 0}});
  EXPECT_LT((square - Eigen::Vector3d(0, 1.2 * pressure, 0)).norm(), 1e-12 * pressure);
  EXPECT_LT((flat - Eigen::Vector3d((1.2 - 1.5 * 0.72) * pressure, 0, 0)).norm(), 1e-12 * pressure);
}

// Nor does it matter which way a face is listed.
TEST(WindForce, PushesBothSidesAlike) {
  const Plate plate;
  const Wind wind{.velocity = {2.0, 3.0, -1.0}};
  const State state = test::shaken_state(plate.structure, 0.05, 1.0);
  const Eigen::MatrixX3d front = test::force_of(WindForce(plate.structure, wind, plate.front, 0), state);
  const Eigen::MatrixX3d back = test::force_of(WindForce(plate.structure, wind, plate.back, 0), state);
  EXPECT_LT((front - back).norm(), 1e-14 * front.norm());
  const Eigen::Vector3d below = plate.push({.velocity = {2, 3, -1}}), above = plate.push({.velocity = {2, -3, -1}});
  EXPECT_LT((below - Eigen::Vector3d(above.x(), -above.y(), above.z())).norm(), 1e-14 * below.norm());
}

TEST(WindForce, VanishesWhereNothingMovesAgainstTheAir) {
  const Plate plate;
  EXPECT_EQ(plate.push({}), Eigen::Vector3d::Zero());
  const Wind wind{.velocity = {3.0, 1.0, 0.5}};
  EXPECT_EQ(plate.push(wind, plate.moving(wind.velocity)), Eigen::Vector3d::Zero());
  EXPECT_EQ(plate.damping(wind, wind.velocity), Eigen::Matrix3d::Zero());
}

TEST(WindForce, DependsOnTheRelativeVelocityAlone) {
  const Plate plate;
  const Eigen::Vector3d wind(3.0, 1.0, 0.5), plates(-1.0, 2.0, 0.3);
  const Eigen::Vector3d both = plate.push({.velocity = wind}, plate.moving(plates));
  EXPECT_LT((both - plate.push({.velocity = wind - plates})).norm(), 1e-13 * both.norm());
}

// Through a wind along the face, through rest, and where the square ends.
TEST(WindForce, NeverJumpsAndNorDoesItsSlope) {
  const Plate plate;
  const Wind air{.quadratic_to = 4.0};
  constexpr double d = 1e-7;
  const auto expect_smooth = [&](const Eigen::Vector3d& v, const Eigen::Vector3d& way) {
    const Eigen::Vector3d before = plate.push(air, plate.moving(v - d * way)),
                          after = plate.push(air, plate.moving(v + d * way));
    EXPECT_LT((after - before).norm(), 20.0 * d);
    EXPECT_LT((plate.damping(air, v + d * way) - plate.damping(air, v - d * way)).norm(), 20.0 * d);
  };
  expect_smooth({3.0, 0.0, 1.0}, Eigen::Vector3d::UnitY());
  expect_smooth({0.0, 0.0, 0.0}, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
  expect_smooth(blowing(4.0, 25.0), blowing(1.0, 25.0));
}

// 2 V v - V^2 in place of v^2.
TEST(WindForce, GrowsAlongAStraightLineWhereTheSquareEnds) {
  const Plate plate;
  for (const double speed : {8.0, 20.0, 300.0}) {
    const double expected = 0.5 * rho * area * 1.2 * (2.0 * 7.0 * speed - 49.0);
    EXPECT_NEAR(plate.push({.velocity = {0, speed, 0}, .quadratic_to = 7.0}).y(), expected, 1e-12 * expected);
  }
}

TEST(WindForce, PushesEveryCornerOfAFaceAlikeAndAWholeClothAsItsFaces) {
  const Structure sheet = test::laws::sheet(SpringModel::linear, DampingModel::projected);
  const State state = test::laws::shaken(sheet, 3);
  const Wind wind{.velocity = {2, 3, -1}, .gusts = Gusts{.length = 0.5}};
  Eigen::MatrixX3d sum = Eigen::MatrixX3d::Zero(sheet.particles(), 3);
  for (const Face& face : test::laws::sheet_faces()) {
    const Eigen::MatrixX3d one = test::force_of(WindForce(sheet, wind, {face}, 0), state);
    for (int c = 1; c < corner_count(face); ++c) EXPECT_EQ(one.row(face[c]), one.row(face[0]));
    sum += one;
  }
  const Eigen::MatrixX3d all = test::force_of(WindForce(sheet, wind, test::laws::sheet_faces(), 0), state);
  EXPECT_LT((all - sum).norm(), 1e-14 * all.norm());
}

// Whichever threads there are.
TEST(WindForce, HasTheSameBitsOnAnyNumberOfThreads) {
  const int side = 60;
  const Structure sheet = test::grid({.width = side, .height = side, .spacing = 0.02});
  std::vector<Face> faces;
  for (int k = 0; k < side * (side - 1); ++k)
    if (k % side + 1 < side) faces.push_back({k, k + side, k + side + 1, k + 1});
  const WindForce wind(sheet, {.velocity = {2, 3, -1}, .gusts = Gusts{}}, faces, 0);
  const State before = test::shaken_state(sheet, 0.005, 1.0, 1), after = test::shaken_state(sheet, 0.005, 1.0, 2);
  const auto on = [&](int threads) {
    Eigen::MatrixX3d force;
    double work = 0.0;
    oneapi::tbb::task_arena(threads).execute(
        [&] { force = test::force_of(wind, before), work = wind.work(before, after); });
    return std::pair(force, work);
  };
  const auto alone = on(1);
  for (const int threads : {2, 5}) EXPECT_EQ(on(threads), alone);
}

TEST(WindForce, CountsAFaceThatHasGrownUpToItsLargestGrowth) {
  const Plate plate;
  const Wind wind{.velocity = {1, 3, 0}};
  const double still = plate.push(wind).norm();
  for (const double growth : {0.5, 1.3, WindForce::largest_growth, 5.0}) {
    State state = rest_state(plate.structure);
    state.position *= std::sqrt(growth);
    const double counted = std::min(growth, WindForce::largest_growth);
    EXPECT_NEAR(plate.push(wind, state).norm(), counted * still, 1e-12 * still);
  }
  State collapsed = rest_state(plate.structure);
  collapsed.position.setZero();
  EXPECT_EQ(plate.push(wind, collapsed), Eigen::Vector3d::Zero());
}

/// x . C x over x . x, of a face whose corners move alike, at most: 1/2 rho A drag V is 1.
struct Range {
  double least = INFINITY, most = -INFINITY;
};

Range damping_over_all_flows(double lift) {
  const Plate plate;
  const Wind air{.drag = 1.0, .lift = lift, .quadratic_to = 3.0};
  const double unit = 0.5 * rho * area * 3.0;
  Range range;
  for (const double speed : {0.3, 1.0, 2.9, 3.0, 3.1, 3.5, 4.0, 5.0, 7.0, 10.0, 20.0, 100.0})
    for (double degrees = 0.0; degrees <= 90.0; degrees += 1.5) {
      const Eigen::Matrix3d damping = plate.damping(air, blowing(speed, degrees)) / unit;
      range.least = std::min(range.least, test::least_eigenvalue(damping));
      range.most = std::max(range.most, -test::least_eigenvalue(-damping));
    }
  return range;
}

// Nowhere negative, nowhere more than the bound, and where the wind comes squarely hardly less.
TEST(WindForce, DampsEveryMotionAndNeverMoreThanItsBound) {
  const Plate plate;
  Linearisation bound(plate.structure);
  EXPECT_TRUE(WindForce(plate.structure, {.drag = 1.0, .lift = 0.0, .quadratic_to = 3.0}, plate.front, 0)
                  .add_bound(Shapes::rest, bound));
  EXPECT_TRUE(bound.stiffness.is_zero());
  const Eigen::Matrix3d most = plate.together(bound.damping) / (0.5 * rho * area * 3.0);
  EXPECT_LT((most - most(0, 0) * Eigen::Matrix3d::Identity()).norm(), 1e-12);
  for (const double lift : {0.0, 0.2, 0.4, Wind::most_lift}) {
    SCOPED_TRACE(lift);
    const Range range = damping_over_all_flows(lift);
    EXPECT_GE(range.least, 0.0);
    EXPECT_LE(range.most, most(0, 0));
    EXPECT_GT(range.most, 0.99 * most(0, 0));
  }
}

// The largest lift is chosen so; beyond it the air would drive a motion against it.
TEST(WindForce, WouldNotDampEveryMotionWithMoreLift) { EXPECT_LT(damping_over_all_flows(0.65).least, -0.01); }

// sqrt(2 m g / (rho drag A)), which no motion overshoots.
TEST(WindForce, LetsAPlateFallAtItsTerminalVelocity) {
  const Plate plate;
  Forces forces(plate.structure, {0.0, -9.81, 0.0});
  forces.add(std::make_unique<WindForce>(plate.structure, Wind{}, plate.front, 0));
  State state = rest_state(plate.structure);
  const double terminal = std::sqrt(2.0 * 0.04 * 9.81 / (rho * 1.2 * area));
  constexpr double h = 1e-3;
  for (; state.time < 3.0; state.time += h) {
    state.velocity += h * test::acceleration_of(forces, state);
    state.position += h * state.velocity;
    EXPECT_LE(state.velocity.col(1).cwiseAbs().maxCoeff(), terminal);
  }
  EXPECT_NEAR(state.velocity.col(1).maxCoeff(), -terminal, 1e-6 * terminal);
  EXPECT_LT(state.velocity.col(0).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(WindForce, LinearisesItsGustsFromPlaceToPlace) {
  const Structure sheet = test::laws::sheet(SpringModel::linear, DampingModel::projected);
  const WindForce wind(sheet, {.velocity = {2, 3, -1}, .gusts = Gusts{.strength = 0.5, .length = 0.5}},
                       test::laws::sheet_faces(), 0);
  const State state = test::laws::shaken(sheet, 2);
  StiffnessMatrix matrix(sheet);
  wind.add_linearisation(state, 1.0, 0.0, JacobianForm::exact, matrix);
  const Eigen::MatrixXd slope =
      test::minus_slope([&](const State& at) { return test::force_of(wind, at); }, state, &State::position, 1e-6);
  EXPECT_LT((Eigen::MatrixXd(matrix.assemble(false)) - slope).norm(), 1e-6 * slope.norm());
}

// Its push times the air's own velocity halfway.
TEST(WindForce, WorksByTheGustsThatItMeets) {
  const Plate plate;
  const Wind blowing{.velocity = {2, 3, -1}, .gusts = Gusts{}};
  const WindField field(blowing.velocity, blowing.gusts);
  const WindForce wind(plate.structure, blowing, plate.front, 0);
  State before = plate.moving({0.3, 0.2, 0.1}), after = before;
  before.time = 1.0, after.time = 1.2;
  after.position.array() += 0.04;
  State halfway = before;
  halfway.time = 1.1;
  halfway.position.array() += 0.02;
  const Eigen::Vector3d middle = halfway.position.colwise().mean().transpose();
  const double expected = 0.2 * plate.push(blowing, halfway).dot(field.velocity(middle, 1.1));
  EXPECT_GT(expected, 0.0);
  EXPECT_NEAR(wind.work(before, after), expected, 1e-12 * expected);
}

const Eigen::Vector3d mean(5.0, 0.0, 2.0);

Eigen::MatrixX3d gusts_at_places(const Gusts& gusts) {
  const WindField field(mean, gusts);
  const Eigen::MatrixX3d place = 10.0 * seeded_noise(20, 3);
  Eigen::MatrixX3d velocity(20, 3);
  for (int k = 0; k < 20; ++k) velocity.row(k) = field.velocity(place.row(k).transpose(), 0.7 * k).transpose();
  return velocity;
}

TEST(WindField, IsTheSameForTheSameSeedAndAnotherForAnother) {
  EXPECT_EQ(gusts_at_places({.seed = 7}), gusts_at_places({.seed = 7}));
  EXPECT_GT((gusts_at_places({.seed = 7}) - gusts_at_places({.seed = 8})).norm(), 1.0);
}

TEST(WindField, HasNoGustsInStillAirOrWithoutStrength) {
  EXPECT_EQ(WindField(Eigen::Vector3d::Zero(), Gusts{}).velocity({1, 2, 3}, 4.0), Eigen::Vector3d::Zero());
  EXPECT_EQ(WindField(mean, Gusts{.strength = 0.0}).velocity({1, 2, 3}, 4.0), mean);
  EXPECT_EQ(WindField(mean, std::nullopt).velocity({1, 2, 3}, 4.0), mean);
}

TEST(WindField, HasTheMeanAndTheStrengthThatItIsGiven) {
  for (const std::uint64_t seed : {0, 1, 2}) {
    const WindField field(mean, Gusts{.strength = 0.3, .seed = seed});
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double squares = 0.0;
    constexpr int samples = 40000;
    for (int k = 0; k < samples; ++k) {
      const Eigen::Vector3d gust = field.velocity({1, 2, 3}, 0.05 * k) - mean;
      sum += gust, squares += gust.squaredNorm();
    }
    EXPECT_LT((sum / samples).norm(), 0.01 * mean.norm());
    EXPECT_NEAR(std::sqrt(squares / samples), 0.3 * mean.norm(), 0.003 * mean.norm());
  }
}

/// Mean of a gust times what it is a while later, the wind's way times `share` from there.
double likeness(const WindField& field, double share) {
  constexpr double later = 0.4;
  double sum = 0.0;
  for (int k = 0; k < 4000; ++k) {
    const Eigen::Vector3d here(0.0, 1.0, 2.0), there = here + share * later * mean;
    sum += (field.velocity(here, 0.1 * k) - mean).dot(field.velocity(there, 0.1 * k + later) - mean);
  }
  return sum;
}

TEST(WindField, DriftsWithTheWind) {
  for (const std::uint64_t seed : {0, 1, 2, 3}) {
    const WindField field(mean, Gusts{.period = 2.0, .length = 2.0 * mean.norm(), .seed = seed});
    EXPECT_GT(likeness(field, 1.0), likeness(field, 0.0));
    EXPECT_GT(likeness(field, 0.0), likeness(field, -1.0));
  }
}

TEST(WindField, IsNotCompressedAnywhereAndHasTheGradientThatItSays) {
  const WindField field(mean, Gusts{.strength = 0.5, .period = 1.0, .length = 2.0});
  constexpr double d = 1e-5;
  for (const double time : {0.0, 0.4, 3.1}) {
    const Eigen::Vector3d place(0.3 * time, 1.0, -time);
    const Eigen::Matrix3d gradient = field.gradient(place, time);
    EXPECT_NEAR(gradient.trace(), 0.0, 1e-13 * gradient.norm());
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = d * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector3d slope = (field.velocity(place + step, time) - field.velocity(place - step, time)) / (2 * d);
      EXPECT_LT((gradient.col(axis) - slope).norm(), 1e-8 * gradient.norm());
    }
  }
}

}  // namespace
}  // namespace billow::sim
