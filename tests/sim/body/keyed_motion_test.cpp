// A keyed motion is smooth, does not overshoot, and turns about its pivot.
#include "sim/body/keyed_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"

namespace billow::sim {
namespace {

constexpr double pi = std::numbers::pi;
const Eigen::Vector3d pivot{0.3, -0.2, 0.5};
const Eigen::Vector3d point{1.0, 2.0, -0.7};

// Uneven in time, with components that turn around, rest, and go on.
KeyedMotion wild() {
  return {{{.time = 0.5},
           {.time = 0.7, .translation = {1.0, 0.0, -2.0}, .rotation = {0.1, 3.0, 0.0}},
           {.time = 2.0, .translation = {1.2, 0.0, 5.0}, .rotation = {0.2, 9.0, -1.0}},
           {.time = 2.1, .translation = {9.0, 0.1, 5.0}, .rotation = {-0.4, 12.0, -1.0}},
           {.time = 4.0, .translation = {9.5, 0.1, 4.0}, .rotation = {0.0, 6.0 * pi, 2.0}}},
          pivot};
}

TEST(KeyedMotion, PassesThroughItsKeysAndRestsOutsideThem) {
  const KeyedMotion motion({{.time = 1.0}, {.time = 3.0, .translation = {1.0, 2.0, 3.0}}}, pivot);
  EXPECT_EQ(motion.at(-1.0) * point, point);
  EXPECT_EQ(motion.at(1.0) * point, point);
  EXPECT_EQ(motion.at(2.0) * point, point + Eigen::Vector3d(0.5, 1.0, 1.5)) << "half-way, by symmetry";
  EXPECT_EQ(motion.at(3.0) * point, point + Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(motion.at(9.0) * point, motion.at(3.0) * point);
  for (const double time : {0.5, 1.0, 3.0, 9.0}) EXPECT_TRUE((motion.velocity_at(time) * point).isZero(0.0)) << time;
}

TEST(KeyedMotion, RestsWithoutKeys) {
  EXPECT_EQ(KeyedMotion().at(2.0) * point, point);
  EXPECT_EQ(KeyedMotion({}, pivot).at(2.0) * point, point);
  EXPECT_TRUE((KeyedMotion().velocity_at(2.0) * point).isZero(0.0));
  EXPECT_FALSE(KeyedMotion().moves());
  EXPECT_FALSE(KeyedMotion({{.time = 1.0}, {.time = 2.0}}, pivot).moves());
  EXPECT_TRUE(wild().moves());
}

TEST(KeyedMotion, StaysWhereItsOnlyKeyPutsIt) {
  const KeyedMotion motion({{.time = 5.0, .translation = {0.0, 1.0, 0.0}}}, pivot);
  for (const double time : {0.0, 5.0, 7.0}) EXPECT_EQ(motion.at(time) * point, point + Eigen::Vector3d::UnitY());
  EXPECT_TRUE(motion.moves());
}

// The cubics are continuous to the first derivative: what crosses a key is O(step) in velocity.
TEST(KeyedMotion, HasAContinuousVelocityThatIsTheDerivativeOfItsPosition) {
  const KeyedMotion motion = wild();
  constexpr double step = 1e-5;
  for (int k = 0; k <= 450; ++k) {
    const double time = 0.01 * k;  // every key's time among them
    const Eigen::Vector3d slope = (motion.at(time + step) * point - motion.at(time - step) * point) / (2.0 * step);
    EXPECT_LT((motion.velocity_at(time) * point - slope).norm(), 0.05) << time;
    const double jump = (motion.velocity_at(time + 1e-9) * point - motion.velocity_at(time - 1e-9) * point).norm();
    EXPECT_LT(jump, 1e-4) << time;
  }
}

TEST(KeyedMotion, HasTheDerivativeOfItsPositionToRoundingBetweenKeys) {
  const KeyedMotion motion = wild();
  for (const double time : {0.55, 1.3, 2.05, 3.1, 3.9}) {
    constexpr double step = 1e-4;
    const auto x = [&](double steps) -> Eigen::Vector3d { return motion.at(time + steps * step) * point; };
    const Eigen::Vector3d slope = (8.0 * (x(1) - x(-1)) - (x(2) - x(-2))) / (12.0 * step);  // fourth order
    EXPECT_LT((motion.velocity_at(time) * point - slope).norm(), 1e-7) << time;
  }
}

// Every component stays between the two keys around it: seen of translations, which the motion shows as they are.
TEST(KeyedMotion, DoesNotOvershoot) {
  const std::vector<PlaceKey> keys{{.time = 0.0, .translation = {0.0, 0.0, 0.0}},
                                   {.time = 0.1, .translation = {1.0, 1.0, 0.001}},
                                   {.time = 3.0, .translation = {1.0, 1.001, 5.0}},
                                   {.time = 3.1, .translation = {0.0, 8.0, 5.001}},
                                   {.time = 5.0, .translation = {2.0, 8.0, 5.002}}};
  const KeyedMotion motion(keys, pivot);
  for (std::size_t k = 0; k + 1 < keys.size(); ++k)
    for (int i = 0; i <= 1000; ++i) {
      const double time = keys[k].time + 0.001 * i * (keys[k + 1].time - keys[k].time);
      const Eigen::Vector3d now = motion.at(time).translation();
      const Eigen::Vector3d low = keys[k].translation.cwiseMin(keys[k + 1].translation);
      const Eigen::Vector3d high = keys[k].translation.cwiseMax(keys[k + 1].translation);
      EXPECT_TRUE((now.array() >= low.array() - 1e-15).all() && (now.array() <= high.array() + 4e-15).all()) << time;
    }
}

// Even keys: constant velocity between the first stretch, which sets out, and the last, which comes to rest.
TEST(KeyedMotion, GoesEvenlyThroughEvenKeys) {
  std::vector<PlaceKey> keys;
  for (int k = 0; k < 5; ++k) keys.push_back({.time = 0.5 * k, .translation = {0.25 * k, 0.0, 0.0}});
  const KeyedMotion motion(keys, pivot);
  for (const double time : {0.5, 0.77, 1.0, 1.31, 1.5})
    EXPECT_NEAR((motion.velocity_at(time) * point).x(), 0.5, 1e-14) << time;
}

TEST(KeyedMotion, TurnsAboutItsPivotAndMayTurnSeveralTimes) {
  const KeyedMotion motion({{.time = 0.0}, {.time = 8.0, .rotation = {0.0, 8.0 * pi, 0.0}}}, pivot);
  double turned = 0.0;
  Eigen::Vector3d before = point - pivot;
  for (int k = 1; k <= 800; ++k) {
    const Eigen::Isometry3d now = motion.at(0.01 * k);
    EXPECT_LT((now * pivot - pivot).norm(), 1e-15);
    EXPECT_LT((motion.velocity_at(0.01 * k) * pivot).norm(), 1e-14);
    const Eigen::Vector3d arm = now * point - pivot;
    EXPECT_NEAR(arm.norm(), (point - pivot).norm(), 1e-14);
    turned += std::atan2(before.cross(arm).y(), before.x() * arm.x() + before.z() * arm.z());
    before = arm;
  }
  EXPECT_NEAR(turned, 8.0 * pi, 1e-10);
  EXPECT_LT((motion.at(8.0) * point - point).norm(), 1e-14);
}

TEST(KeyedMotion, TurnsAboutFixedAxesXFirst) {
  const KeyedMotion motion({{.time = 0.0, .rotation = {pi / 2.0, pi / 2.0, 0.0}}}, Eigen::Vector3d::Zero());
  EXPECT_LT((motion.at(0.0) * Eigen::Vector3d::UnitY() - Eigen::Vector3d::UnitX()).norm(), 1e-15)
      << "y to z about x, then z to x about y";
}

TEST(KeyedMotion, RefusesKeysThatDoNotAscend) {
  EXPECT_THROW(KeyedMotion({{.time = 1.0}, {.time = 1.0}}, pivot), InputError);
  EXPECT_THROW(KeyedMotion({{.time = 1.0}, {.time = 0.5}}, pivot), InputError);
}

}  // namespace
}  // namespace billow::sim
