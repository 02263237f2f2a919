// Fish and water in scenes: what is read, what is refused, and that the camera stays beside the fish.
#include <gtest/gtest.h>

#include "cli/drawn/drawn_scene.h"
#include "cli/scene/simulation.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

const char* const two_fish = R"(billow: 1
bodies:
  - name: large
    fish: {length: 3.6, position: [1, 2, 3], heading: 90, motion: {lag: 45, keys: [{time: 1, swim: 0.5, frequency: 2}]}}
  - name: small
    fish: {length: 0.9, motion: {keys: []}}
water: {resistance: 500, current: [0.1, 0, 0]}
render: {camera: {follow: small}}
)";

TEST(SceneFish, IsReadWithDefaultsForItsLength) {
  const test::SceneFolder folder;
  const cli::Scene scene = cli::read_scene(folder.scene(two_fish));
  const auto& large = std::get<cli::FishSpec>(scene.bodies[0].kind);
  EXPECT_DOUBLE_EQ(large.options.mass.ring[1], 8.0 * 11.0);
  EXPECT_DOUBLE_EQ(large.options.cross, 2.0 * 38.0);
  EXPECT_DOUBLE_EQ(large.options.viscosity, 4.0 * 0.1);
  EXPECT_EQ(large.options.position, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR((large.options.rotation * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_EQ(large.motion.keys.at(0).frequency, 2.0);
  EXPECT_TRUE(std::get<cli::FishSpec>(scene.bodies[1].kind).motion.keys.empty());
  EXPECT_EQ(scene.water.resistance, 500.0);
  EXPECT_EQ(scene.followed, 1);
}

TEST(SceneFish, ReadsBackFromTheEffectiveScene) {
  const test::SceneFolder folder;
  const cli::Scene scene = cli::read_scene(folder.scene(two_fish));
  EXPECT_EQ(cli::read_scene(folder.write("again.yaml", scene.effective)).effective, scene.effective);
}

TEST(SceneFish, IsRefusedWithThePlace) {
  const test::SceneFolder folder;
  const auto error = [&](const std::string& body, const std::string& rest = "") {
    return test::scene_error(folder.scene("billow: 1\nbodies: [{" + body + "}]\n" + rest));
  };
  EXPECT_EQ(error("fish: {}, cloth: {mesh: cloth.obj}"),
            "scene.yaml:2:17: a body is of one kind, and this one has 'cloth' and 'fish'; make it two bodies");
  EXPECT_EQ(error("fish: {mass: {rings: [1, 2]}}"), "scene.yaml:2:32: rings must list 5 masses, from head to tail");
  EXPECT_EQ(error("fish: {motion: {keys: [{time: 0}, {time: 0.2}]}}"),
            "scene.yaml:2:45: keys[1] must come at least the transition of 0.5 s after keys[0]");
  EXPECT_EQ(error("name: a, fish: {}", "render: {camera: {follow: b}}\n"),
            "scene.yaml:3:27: there is no body 'b' to follow; the scene has: a");
  EXPECT_EQ(error("fish: {tail: 3}").substr(0, 36), "scene.yaml:2:18: unknown key 'tail' ");
}

// The camera moves as far as the fish, so in the picture its centre of mass stays where it was.
TEST(SceneFish, StaysInThePictureOfACameraThatFollows) {
  const test::SceneFolder folder;
  const cli::Scene scene =
      cli::read_scene(folder.scene("billow: 1\nbodies: [{name: a, fish: {velocity: [2, 0, 1], motion: {keys: []}}}]\n"
                                   "water: {resistance: 0}\nrender: {camera: {follow: a}}\n"));
  const cli::Simulation simulation(scene);
  const cli::DrawnScene drawn(scene, simulation);
  const auto start = drawn.surfaces(simulation.initial_state());
  const auto later = drawn.surfaces(simulation.make_solver(simulation.choose_step())->sample(2.0));
  EXPECT_LT((start[0].position - later[0].position).cwiseAbs().maxCoeff(), 1e-4f);
}

}  // namespace
}  // namespace billow
