// What contact does to velocities: closed forms, momentum, and no energy out of nothing.
#include "sim/contact/impulses.h"

#include <gtest/gtest.h>

#include "sim/body/momenta.h"
#include "tests/support/directions.h"
#include "tests/support/touching_scenes.h"

namespace billow::sim {
namespace {

constexpr double h = 1e-3;  // [s]

/// Two crossed edges of free triangles, `gap` [m] apart beyond their thickness, the upper one over the lower one.
struct Crossed {
  explicit Crossed(double gap) {
    Structure& structure = scene.structure;
    structure.rest_position.resize(6, 3);
    const double y = 0.01 + gap;
    structure.rest_position << -1, y, 0, 1, y, 0, 0, 1 + y, 0.2, 0, 0, -1, 0, 0, 1, 0.2, -1, 0;
    structure.mass = Eigen::VectorXd::Ones(6);
    structure.inverse_mass = structure.mass;
    structure.body = {{.name = "upper", .particles = 3}, {.name = "lower", .first_particle = 3, .particles = 3}};
    for (int b = 0; b < 2; ++b)
      scene.contact.body.push_back(
          {.touches = true, .self = false, .thickness = 0.01, .friction = 0.3, .face = {Face{0, 1, 2, -1}}});
    surface.emplace(structure, scene.contact);
    velocity.assign(6, Eigen::Vector3d::Zero());
  }

  void touch() {
    Detection detection(*surface);
    detection.detect(surface->rest, velocity, 0.0, h, 4.0);
    Impulses impulses(*surface);
    impulses.remember(detection.pairs());
    impulses.apply(detection.pairs(), {}, Points(2, Eigen::Vector3d::Zero()), surface->rest, h, {}, velocity);
  }

  Eigen::Vector3d momentum() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& v : velocity) sum += v;
    return sum;
  }

  test::TouchingScene scene;
  std::optional<ContactSurface> surface;
  Points velocity;
};

TEST(Impulses, StopTwoEdgesThatMeetAtTheirMiddles) {
  Crossed crossed(0.0);
  for (int i = 0; i < 2; ++i) crossed.velocity[i] = {0.0, -2.0, 0.0};
  crossed.touch();
  // Equal edges share their momentum.
  for (const int i : {0, 1, 3, 4}) EXPECT_NEAR(crossed.velocity[i](1), -1.0, 1e-12) << i;
  EXPECT_LT((crossed.momentum() - Eigen::Vector3d(0.0, -4.0, 0.0)).norm(), 1e-13);
}

// All but one corner are held, and that one is hardly part of the contact: as beside a pin that is pressed on.
TEST(Impulses, ThrowNothingAsideThatHardlyTakesPart) {
  Crossed crossed(0.0);
  Structure& structure = crossed.scene.structure;
  structure.rest_position.col(2).head(3).array() -= 1.0 - 1e-9;
  structure.inverse_mass.setZero();
  structure.inverse_mass(4) = 1.0;
  crossed.surface.emplace(structure, crossed.scene.contact);
  for (int i = 0; i < 3; ++i) crossed.velocity[i] = {0.0, -2.0, 0.0};
  crossed.touch();
  EXPECT_LT(crossed.velocity[4].norm(), 1.0);
}

TEST(Impulses, LetAGapBeClosedWithinTheStepAndNoMore) {
  constexpr double gap = 0.0008;
  Crossed crossed(gap);
  for (int i = 0; i < 2; ++i) crossed.velocity[i] = {0.0, -2.0, 0.0};
  crossed.touch();
  const double closing =
      0.5 * (crossed.velocity[3] + crossed.velocity[4] - crossed.velocity[0] - crossed.velocity[1])(1);
  EXPECT_NEAR(closing, gap / h, 1e-9);
}

TEST(Impulses, LeaveWhatSeparatesAlone) {
  Crossed crossed(0.0);
  for (int i = 0; i < 2; ++i) crossed.velocity[i] = {0.3, 1.0, 0.0};
  const Points before = crossed.velocity;
  crossed.touch();
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(crossed.velocity[i], before[i]);
}

TEST(Impulses, SlowSlidingByFrictionAsCoulombSays) {
  Crossed crossed(0.0);
  for (int i = 0; i < 2; ++i) crossed.velocity[i] = {2.0, -1.0, 0.0};
  crossed.touch();
  // The blow changes each edge's speed along the normal by 1/2, and what slides by 0.3 of that.
  EXPECT_NEAR(crossed.velocity[0](1), -0.5, 1e-9);
  EXPECT_NEAR(crossed.velocity[0](0), 2.0 - 0.3 * 0.5, 1e-9);
  EXPECT_NEAR(crossed.velocity[3](0), 0.3 * 0.5, 1e-9);
}

TEST(Impulses, HoldWhatFrictionCanHold) {
  Crossed crossed(0.0);
  for (int i = 0; i < 2; ++i) crossed.velocity[i] = {0.2, -1.0, 0.0};
  crossed.touch();
  EXPECT_NEAR(crossed.velocity[0](0), crossed.velocity[3](0), 1e-9);
}

// A heap of cloth with random velocities: momentum stays, energy falls.
TEST(Impulses, KeepMomentumAndNeverGiveEnergy) {
  const auto scene =
      test::touching_scene("heap",
                           {{.mesh = test::flat_sheet(9, 9, 0.3, {0, 0, 0}), .friction = 0.5},
                            {.mesh = test::flat_sheet(9, 9, 0.3, {0.01, 0.004, 0.012}), .friction = 0.5},
                            {.mesh = test::flat_sheet(9, 9, 0.3, {0.02, 0.0085, 0.003}), .friction = 0.5}},
                           {}, 1.0);
  const ContactSurface surface(scene->structure, scene->contact);
  Detection detection(surface);
  Impulses impulses(surface);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::Directions random(seed);
    State state = rest_state(scene->structure);
    Points v;
    for (int i = 0; i < surface.particles; ++i) v.push_back(random.next()), state.velocity.row(i) = v.back();
    const double energy = kinetic_energy(scene->structure, state);
    const Eigen::Vector3d linear = linear_momentum(scene->structure, state);
    detection.detect(surface.rest, v, 0.0, h, 4.0);
    impulses.remember(detection.pairs());
    impulses.apply(detection.pairs(), {}, Points(3, Eigen::Vector3d::Zero()), surface.rest, h, {}, v);
    for (int i = 0; i < surface.particles; ++i) state.velocity.row(i) = v[i];
    EXPECT_LT(kinetic_energy(scene->structure, state), energy) << seed;
    EXPECT_LT((linear_momentum(scene->structure, state) - linear).norm(), 1e-13) << seed;
    EXPECT_EQ(impulses.work(), 0.0);
  }
}

}  // namespace
}  // namespace billow::sim
