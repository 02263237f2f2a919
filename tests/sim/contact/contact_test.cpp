// Contact within runs: friction on a slope against the closed form, momentum, rest, energy, and what is refused.
#include "sim/contact/contact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "sim/body/momenta.h"
#include "sim/mesh/shapes.h"
#include "tests/support/touching_scenes.h"

namespace billow::sim {
namespace {

using test::TouchingRun;

constexpr double g = 9.81;  // [m/s^2]

/// A small cloth on a plane that is tilted about the z axis, as a half-space or as a mesh: gravity is tilted instead.
std::unique_ptr<test::TouchingScene> on_a_slope(double angle, double friction, bool as_mesh) {
  Collider plane;
  plane.name = "slope";
  plane.friction = friction;
  if (as_mesh)
    plane.mesh = test::flat_sheet(3, 3, 30.0, {0.0, 0.0, 0.0});
  else
    plane.half_space = HalfSpace{};
  auto scene = test::touching_scene(
      "slope", {{.mesh = test::flat_sheet(5, 5, 0.1, {0.0, 0.0031, 0.0}), .friction = friction, .drag = 0.0}}, {plane},
      1.0);
  scene->gravity = {g * std::sin(angle), -g * std::cos(angle), 0.0};
  return scene;
}

class Slope : public testing::TestWithParam<bool> {};

TEST_P(Slope, HoldsBelowTheAngleOfFriction) {
  constexpr double friction = 0.4;
  const auto scene = on_a_slope(std::atan(0.95 * friction), friction, GetParam());
  TouchingRun run(*scene);
  const State settled = run.sample(0.2), later = run.sample(1.0);
  EXPECT_LT((later.position - settled.position).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_P(Slope, SlidesAboveItAsCoulombSays) {
  constexpr double friction = 0.4;
  const double angle = std::atan(2.0 * friction);
  const auto scene = on_a_slope(angle, friction, GetParam());
  TouchingRun run(*scene);
  const State early = run.sample(0.3), late = run.sample(0.9);
  const double gained = late.velocity.col(0).mean() - early.velocity.col(0).mean();
  const double expected = g * (std::sin(angle) - friction * std::cos(angle)) * (late.time - early.time);
  EXPECT_NEAR(gained / expected, 1.0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Plane, Slope, testing::Bool(), [](const auto& as) {
  return as.param ? std::string("OfTriangles") : std::string("HalfSpace");
});

TEST(Contact, KeepsTheMomentumOfTwoBodiesThatMeet) {
  auto scene = test::touching_scene(
      "meeting",
      {{.mesh = test::flat_sheet(10, 10, 0.4, {0, 0, 0}), .drag = 0.0, .velocity = {0.0, 1.0, 0.0}},
       {.mesh = test::flat_sheet(9, 7, 0.3, {0.05, 0.03, 0.01}),
        .mass = 0.05,
        .drag = 0.0,
        .velocity = {0.3, -2.0, 0}}},
      {}, 0.3);
  scene->gravity.setZero();
  TouchingRun run(*scene);
  const Eigen::Vector3d linear = linear_momentum(scene->structure, scene->start),
                        angular = angular_momentum(scene->structure, scene->start);
  const double energy = kinetic_energy(scene->structure, scene->start);
  const State last = run.sample(scene->duration);
  EXPECT_LT(kinetic_energy(scene->structure, last) + run.forces().potential_energy(last), 0.95 * energy);
  EXPECT_LT((linear_momentum(scene->structure, last) - linear).norm(), 1e-9);
  // Friction acts across the gap that the thickness keeps, so angular momentum is only kept as far as that is small.
  constexpr double arm = 0.004;  // [m]
  EXPECT_LT((angular_momentum(scene->structure, last) - angular).norm(), arm * 0.15);
  EXPECT_EQ(run.solver().work(), 0.0);
}

TEST(Contact, ClothAtRestStaysAtRestForAMinute) {
  const auto scene =
      test::touching_scene("rest", {{.mesh = test::flat_sheet(8, 8, 0.3, {0.0, 0.004, 0.0}), .drag = 1e-3}}, {[] {
                             Collider ground;
                             ground.name = "ground";
                             ground.half_space = HalfSpace{};
                             return ground;
                           }()},
                           60.0);
  TouchingRun run(*scene);
  const State settled = run.sample(5.0);
  double fastest = 0.0;
  for (double time = 6.0; time <= 60.0; time += 1.0)
    fastest = std::max(fastest, run.sample(time).velocity.rowwise().norm().maxCoeff());
  EXPECT_LT(fastest, 1e-4);  // [m/s]
  EXPECT_LT((run.solver().state().position - settled.position).cwiseAbs().maxCoeff(), 1e-4);
}

// Only the colliders' work comes in: what a turning ball drags along is accounted for.
TEST(Contact, EnergyDoesNotClimbBeyondTheWorkOfColliders) {
  const auto scene = test::touching_scene_named("turning_ball");
  TouchingRun run(*scene);
  const auto energy = [&](const State& state) {
    return kinetic_energy(scene->structure, state) + run.forces().potential_energy(state) - run.solver().work();
  };
  const double first = energy(scene->start), scale = 0.1 * g * 0.5;
  double lowest = first;
  for (double time = 0.05; time <= scene->duration; time += 0.05) {
    const double now = energy(run.sample(time));
    EXPECT_LT(now, lowest + 0.02 * scale) << time;
    lowest = std::min(lowest, now);
  }
  EXPECT_GT(run.solver().work(), 0.0);
}

TEST(Contact, SaysWhatIsCrushedBetweenColliders) {
  Collider ground, lid;
  ground.name = "ground", ground.half_space = HalfSpace{};
  lid.name = "lid";
  lid.mesh = box_mesh({0.0, 0.15, 0.0}, {0.5, 0.2, 0.5}, Eigen::Matrix3d::Identity());
  lid.motion = KeyedMotion({{0.0}, {0.5, {0.0, -0.06, 0.0}, {0.0, 0.0, 0.0}}}, Eigen::Vector3d::Zero());
  const auto scene =
      test::touching_scene("crushed", {{.mesh = test::flat_sheet(6, 6, 0.3, {0.0, 0.01, 0.0})}}, {ground, lid}, 1.0);
  TouchingRun run(*scene);
  try {
    run.sample(0.6);
    FAIL() << "nothing was said";
  } catch (const BlockedError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("cloth_0"));
  }
}

// Not even what cannot be pushed away lets a half-space pass unseen.
TEST(Contact, SaysWhatAPlaneWouldPassThroughThatIsPinned) {
  test::ClothInScene cloth{.mesh = test::flat_sheet(4, 4, 0.2, {0.0, 0.05, 0.0}), .pinned = {0, 4}};
  Collider floor;
  floor.name = "floor", floor.half_space = HalfSpace{};
  floor.motion = KeyedMotion({{0.0}, {0.4, {0.0, 0.1, 0.0}, {0.0, 0.0, 0.0}}}, Eigen::Vector3d::Zero());
  const auto scene = test::touching_scene("lifted", {cloth}, {floor}, 1.0);
  TouchingRun run(*scene);
  EXPECT_THAT([&] { run.sample(0.5); },
              testing::ThrowsMessage<BlockedError>(testing::HasSubstr("'cloth_0' is pressed against 'floor'")));
}

/// What check_start says of a cloth at `middle` and this collider.
std::string refusal(const Collider& collider, const Eigen::Vector3d& middle) {
  const auto scene = test::touching_scene("refused", {{.mesh = test::flat_sheet(6, 6, 0.3, middle)}}, {collider}, 1.0);
  const ContactModel model(scene->structure, scene->contact);
  try {
    check_start(model, scene->start);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CheckStart, NamesTheFacesThatCross) {
  Collider wall;
  wall.name = "wall";
  wall.mesh = box_mesh({0.0, 0.0, 0.0}, {0.05, 0.5, 0.5}, Eigen::Matrix3d::Identity());
  EXPECT_THAT(refusal(wall, {0, 0, 0}),
              testing::AllOf(testing::HasSubstr("'cloth_0' and 'wall' cross where the run"),
                             testing::HasSubstr("the first of them face "), testing::HasSubstr("move them apart")));
  EXPECT_EQ(refusal(wall, {0.2, 0, 0}), "");
}

TEST(CheckStart, SaysWhatStartsInsideAHalfSpaceOrABall) {
  Collider ground;
  ground.name = "ground";
  ground.half_space = HalfSpace{};
  EXPECT_THAT(refusal(ground, {0, -0.1, 0}),
              testing::HasSubstr("49 of the 49 vertices of 'cloth_0' start inside 'ground'"));
  EXPECT_EQ(refusal(ground, {0, 0.1, 0}), "");
  Collider ball;
  ball.name = "ball";
  ball.rounded = Rounded{{0, 0, 0}, {0, 0, 0}, 0.1};
  EXPECT_THAT(refusal(ball, {0, 0.05, 0}), testing::HasSubstr("into 'ball'"));
  EXPECT_EQ(refusal(ball, {0, 0.11, 0}), "");
}

TEST(CheckStart, SaysThatAClothCrossesItself) {
  test::ClothInScene cloth{.mesh = test::flat_sheet(8, 8, 0.4, {0, 0, 0})};
  // One row is bent down and back up through the others.
  for (int z = 0; z <= 8; ++z)
    cloth.mesh.position.row(z * 9) << 0.03, (z % 2 == 0 ? 0.03 : -0.03), cloth.mesh.position(z * 9, 2) + 0.01;
  const auto scene = test::touching_scene("self", {cloth}, {}, 1.0);
  const ContactModel model(scene->structure, scene->contact);
  EXPECT_THAT([&] { check_start(model, scene->start); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("'cloth_0' crosses itself where the run starts")));
}

}  // namespace
}  // namespace billow::sim
