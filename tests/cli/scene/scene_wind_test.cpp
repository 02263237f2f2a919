// Wind in scenes: what is read, what is refused, and that it blows on cloths and soft bodies alone.
#include <gtest/gtest.h>

#include "cli/scene/simulation.h"
#include "tests/support/evaluations.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

class SceneWind : public testing::Test {
 protected:
  cli::Scene read(const std::string& wind, const std::string& body = "cloth: {mesh: cloth.obj}") const {
    return cli::read_scene(folder_.scene("billow: 1\nbodies: [{" + body + "}]\n" + wind + "\n"));
  }
  std::string error(const std::string& wind) const {
    return test::scene_error(folder_.scene("billow: 1\nbodies: [{cloth: {mesh: cloth.obj}}]\n" + wind + "\n"));
  }
  /// [N] of everything that acts on a scene at its start, weight left out.
  Eigen::Vector3d push(const std::string& wind, const std::string& body) const {
    const cli::Scene scene = read("gravity: [0, 0, 0]\n" + wind, body);
    const cli::Simulation simulation(scene);
    return test::force_of(simulation.forces(), simulation.initial_state()).colwise().sum().transpose();
  }

  test::SceneFolder folder_;
};

TEST_F(SceneWind, IsReadWithItsDefaults) {
  EXPECT_FALSE(read("").wind);
  EXPECT_FALSE(read("wind: none").wind);
  const sim::Wind still = read("wind: {}").wind.value();
  EXPECT_TRUE(still.velocity.isZero(0.0));
  EXPECT_FALSE(still.gusts);
  EXPECT_EQ(still.drag, 1.2);
  EXPECT_EQ(still.lift, 0.72);
  EXPECT_EQ(still.density, 1.2);
  EXPECT_EQ(still.quadratic_to, 20.0);
}

// Twice the wind's speed where that is more, and as far as the wind comes in a period.
TEST_F(SceneWind, FindsFromItsSpeedWhatIsLeftToIt) {
  const sim::Wind wind = read("wind: {velocity: [0, 12, 16], gusts: {period: 3}, drag: 2}").wind.value();
  EXPECT_EQ(wind.quadratic_to, 40.0);
  EXPECT_EQ(wind.gusts->length, 60.0);
  EXPECT_EQ(wind.lift, 1.2);
}

TEST_F(SceneWind, IsReadAsItIsGiven) {
  const sim::Wind wind = read(
                             "wind: {velocity: [5, 0, -1], gusts: {strength: 0.4, period: 1.5, length: 4, seed: 9}, "
                             "drag: 1, lift: 0.1, density: 1000, quadratic_to: 8}")
                             .wind.value();
  EXPECT_EQ(wind.velocity, Eigen::Vector3d(5, 0, -1));
  EXPECT_EQ(wind.gusts->strength, 0.4);
  EXPECT_EQ(wind.gusts->period, 1.5);
  EXPECT_EQ(wind.gusts->length, 4.0);
  EXPECT_EQ(wind.gusts->seed, 9u);
  EXPECT_EQ(wind.drag, 1.0);
  EXPECT_EQ(wind.lift, 0.1);
  EXPECT_EQ(wind.density, 1000.0);
  EXPECT_EQ(wind.quadratic_to, 8.0);
}

TEST_F(SceneWind, ReadsBackFromTheEffectiveScene) {
  for (const char* wind : {"wind: none", "wind: {}", "wind: {velocity: [5, 0, 0], drag: 0.7, gusts: {}}"}) {
    SCOPED_TRACE(wind);
    const cli::Scene scene = read(wind);
    EXPECT_EQ(cli::read_scene(folder_.write("again.yaml", scene.effective)).effective, scene.effective);
  }
}

TEST_F(SceneWind, IsRefusedWithThePlace) {
  EXPECT_EQ(error("wind: {drag: 1, lift: 0.7}"),
            "scene.yaml:3:23: lift is 0.7; with a drag of 1 it must be at most 0.6, 0.6 of that");
  EXPECT_EQ(error("wind: strong"), "scene.yaml:3:7: wind must be none or a map, not 'strong'");
  EXPECT_EQ(error("wind: {gusts: seeded}"), "scene.yaml:3:15: gusts must be none or a map, not 'seeded'");
  EXPECT_EQ(error("wind: {velocity: 5}"), "scene.yaml:3:18: velocity must be a list [x, y, z], not '5'");
  EXPECT_EQ(error("wind: {gusts: {period: 0}}"),
            "scene.yaml:3:24: period is 0 s; it must be above 0 and at most 100000 s");
  EXPECT_EQ(error("wind: {density: -1}"),
            "scene.yaml:3:17: density is -1 kg/m³; it must be at least 0 and at most 100000 kg/m³");
  EXPECT_EQ(error("wind: {gusts: {sed: 1}}"), "scene.yaml:3:16: unknown key 'sed' in gusts; did you mean 'seed'?");
  EXPECT_EQ(error("wind: {velocty: [1, 0, 0]}"),
            "scene.yaml:3:8: unknown key 'velocty' in wind; did you mean 'velocity'?");
}

// 1/2 rho A drag v^2 on one square metre, which lies flat.
TEST_F(SceneWind, BlowsOnCloth) {
  const std::string cloth = "cloth: {mesh: cloth.obj}";
  EXPECT_LT((push("wind: {velocity: [0, 5, 0]}", cloth) - Eigen::Vector3d(0, 18, 0)).norm(), 1e-9);
  EXPECT_LT(push("", cloth).norm(), 1e-9);
}

TEST_F(SceneWind, BlowsOnSoftBodiesAndNotOnFish) {
  folder_.write("block.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  EXPECT_GT(push("wind: {velocity: [0, 5, 0]}", "soft: {mesh: block.obj}").y(), 1.0);
  EXPECT_LT(push("wind: {velocity: [0, 5, 0]}", "fish: {motion: {keys: []}}").norm(), 1e-9);
}

// The wind is a law with a bound, so nothing is left out of the step's limit, and it takes part in it.
TEST_F(SceneWind, CountsInTheStepsLimit) {
  const cli::Scene calm = read(""), windy = read("wind: {velocity: [0, 0, 5], quadratic_to: 200}");
  const cli::StepChoice without = cli::Simulation(calm).find_limits(), with = cli::Simulation(windy).find_limits();
  EXPECT_TRUE(with.unbounded.empty());
  EXPECT_LT(with.any_shape.value(), without.any_shape.value());
  EXPECT_LT(with.certified.value(), without.certified.value());
}

// By the seed alone: how a run comes to its states has no part in it.
TEST_F(SceneWind, MovesAClothTheSameWayAgainAndAnotherWithAnotherSeed) {
  const auto moved = [&](const std::string& seed) {
    const cli::Scene scene = read("wind: {velocity: [0, 1, 5], gusts: {seed: " + seed + "}}");
    const cli::Simulation simulation(scene);
    return simulation.make_solver(simulation.choose_step())->sample(0.2).position;
  };
  EXPECT_EQ(moved("3"), moved("3"));
  EXPECT_GT((moved("3") - moved("4")).norm(), 1e-4);
}

}  // namespace
}  // namespace billow
