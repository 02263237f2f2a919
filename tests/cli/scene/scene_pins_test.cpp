// Pins that move and let go, as scenes say it: what is read, what is refused, and that a run does it.
#include <gtest/gtest.h>

#include <cmath>

#include "cli/scene/scene_pins.h"
#include "cli/scene/simulation.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

class ScenePins : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& pins, const std::string& filter = "none") const {
    std::string text = test::edited(test::base_scene, "[{corner: top_left}]", pins);
    return folder_.scene(test::edited(text, "{kernel: exponential, lambda: 1}", filter));
  }
  cli::Scene read(const std::string& pins, const std::string& filter = "none") const {
    return cli::read_scene(file(pins, filter));
  }
  std::string error(const std::string& pins) const { return test::scene_error(file(pins)); }

  test::SceneFolder folder_;
};

constexpr const char* moved =
    "[{vertices: [0, 1], motion: [{time: 0.1}, {time: 1, translate: [0, 0.5, 0], rotate: "
    "[0, 90, 0]}]}, {vertices: [8], until: 0.5}]";

TEST_F(ScenePins, AreReadWithTheirMotionPivotAndEnd) {
  const cli::Scene scene = read(moved);
  const std::vector<cli::PinSpec>& pins = scene.bodies[0].pins;
  ASSERT_EQ(pins.size(), 2u);
  EXPECT_EQ(pins[0].vertices, (std::vector<int>{0, 1}));
  EXPECT_FALSE(pins[0].until);
  EXPECT_EQ(pins[1].until, 0.5);
  EXPECT_FALSE(pins[1].motion.moves());
  const Eigen::Vector3d middle{0.25, 0.0, 0.0};  // of vertices 0 and 1, which lie half a metre apart along x
  EXPECT_LT((pins[0].motion.at(1.0) * middle - (middle + 0.5 * Eigen::Vector3d::UnitY())).norm(), 1e-15);
  EXPECT_LT((pins[0].motion.at(1.0) * Eigen::Vector3d::Zero() - Eigen::Vector3d(0.25, 0.5, 0.25)).norm(), 1e-15)
      << "from -x to +z by a quarter turn about y";
  EXPECT_EQ(cli::held_vertices(pins, 0.0), (std::vector<int>{0, 1, 8}));
  EXPECT_EQ(cli::held_vertices(pins, 0.5), (std::vector<int>{0, 1}));
}

TEST_F(ScenePins, TurnAboutTheirPivot) {
  const cli::Scene scene =
      read("[{corner: top_left, pivot: [1, 0, 0], motion: [{time: 0}, {time: 1, rotate: [0, 0, 180]}]}]");
  EXPECT_LT((scene.bodies[0].pins[0].motion.at(1.0) * Eigen::Vector3d::Zero() - Eigen::Vector3d(2, 0, 0)).norm(),
            1e-15);
}

TEST_F(ScenePins, ReadBackFromTheEffectiveScene) {
  for (const char* pins : {moved, "[{corner: top_left}]"}) {
    const cli::Scene scene = read(pins);
    const cli::Scene again = cli::read_scene(folder_.scene(scene.effective));
    EXPECT_EQ(again.effective, scene.effective);
    EXPECT_EQ(again.bodies[0].pins[0].motion.at(0.6).matrix(), scene.bodies[0].pins[0].motion.at(0.6).matrix());
  }
  EXPECT_NE(read("[{corner: top_left}]").effective.find("until: none"), std::string::npos);
}

TEST_F(ScenePins, AreRefusedWithTheirPlace) {
  EXPECT_EQ(error("[{corner: top_left, motion: [{time: 1}, {time: 1, translate: [1, 0, 0]}]}]"),
            "scene.yaml:11:53: motion[1] is no later than the one before it; sort the keys by time");
  EXPECT_EQ(error("[{corner: top_left, motion: [{translate: [1, 0, 0]}]}]"),
            "scene.yaml:11:42: the key needs the key 'time'");
  EXPECT_EQ(error("[{corner: top_left, motion: [{time: 1, turn: 3}]}]"),
            "scene.yaml:11:52: unknown key 'turn' in the key; its keys are: time, translate, rotate");
  EXPECT_EQ(error("[{corner: top_left, motion: {time: 1}}]"), "scene.yaml:11:41: motion must be a list, not a map");
  EXPECT_EQ(error("[{corner: top_left, motion: [{time: 0, translate: [0, 1, 0]}]}]"),
            "scene.yaml:11:41: a pin starts where the mesh has it, so the first key of its motion says a time and "
            "neither translate nor rotate");
  EXPECT_EQ(error("[{corner: top_left, until: -1}]"),
            "scene.yaml:11:40: until is -1 s; it must be above 0 and at most 100000 s");
  EXPECT_EQ(error("[{corner: top_left, until: 0}]"),
            "scene.yaml:11:40: until is 0 s; it must be above 0 and at most 100000 s");
  EXPECT_EQ(error("[{corner: top_left, until: never}]"),
            "scene.yaml:11:40: until must be none or a number, not 'never'");
  EXPECT_EQ(error("[{corner: top_left, pivot: middle}]"),
            "scene.yaml:11:40: pivot must be a list [x, y, z], not 'middle'");
  EXPECT_EQ(error("[{motion: [{time: 1}]}]"),
            "scene.yaml:11:14: a pin has one of the keys corner, vertices, box, group and weights; this one has 0");
}

TEST_F(ScenePins, MoveAVertexByOneOfThemAlone) {
  const std::string still = "{vertices: [3, 0]}", along =
                                                      "{vertices: [0], motion: [{time: 0}, {time: 1, translate: "
                                                      "[0, 1, 0]}]}";
  EXPECT_EQ(error("[" + still + ", " + along + "]"),
            "scene.yaml:11:45: vertex 0 is already held by the pin at scene.yaml:11:25, and one of the two moves it; "
            "leave it to "
            "one of them");
  EXPECT_EQ(error("[" + along + ", " + along + "]").find("scene.yaml:11:96: vertex 0 is already held"), 0u);
  EXPECT_EQ(error("[" + still + ", " + still + "]"), "");
}

TEST_F(ScenePins, AreTakenByMinusD) {
  const auto scene = [&](const char* until) {
    return cli::read_scene(file("[{corner: top_left}, {vertices: [8]}]"), {{"bodies.sheet.cloth.pins.1.until", until}});
  };
  EXPECT_EQ(scene("0.25").bodies[0].pins[1].until, 0.25);
  EXPECT_EQ(cli::Simulation(scene("0.25")).phases(), 2);
  EXPECT_EQ(cli::Simulation(scene("none")).phases(), 1);
  EXPECT_EQ(cli::Simulation(scene("2")).phases(), 1) << "not before the end of the scene";
}

// A vertex that two pins hold is free when the later lets go; a pin without an end holds it for good.
TEST_F(ScenePins, HoldUntilTheLastLetsGo) {
  const cli::Scene scene = read("[{vertices: [0, 1], until: 0.5}, {vertices: [1, 2], until: 1}, {vertices: [2]}]");
  EXPECT_EQ(cli::release_times(scene), (std::vector<double>{0.5, 1.0}));
  const cli::Simulation simulation(scene);
  ASSERT_EQ(simulation.phases(), 3);
  const auto free = [&](int phase, int particle) { return !simulation.phase(phase).structure.pinned(particle); };
  EXPECT_FALSE(free(0, 0) || free(0, 1) || free(0, 2));
  EXPECT_TRUE(free(1, 0) && !free(1, 1) && !free(1, 2));
  EXPECT_TRUE(free(2, 0) && free(2, 1) && !free(2, 2));
  EXPECT_EQ(simulation.phase(2).structure.inverse_mass(1), 1.0 / simulation.structure().mass(1));
}

// All held in the same scenes' steps: the step of the run is that of the phase with the smallest limit.
TEST_F(ScenePins, TakeTheSmallestStepOfAllPhases) {
  const auto step = [&](const std::string& pins) { return cli::Simulation(read(pins)).choose_step(); };
  const cli::StepChoice held = step("[{vertices: [0, 1, 2, 3, 5, 6, 7, 8]}]"), loose = step("[]");
  const cli::StepChoice both = step("[{vertices: [0, 1, 2, 3, 5, 6, 7, 8], until: 0.5}]");
  EXPECT_GT(held.step, 1.2 * loose.step) << "the test must be able to tell";
  EXPECT_EQ(both.step, loose.step);
  EXPECT_EQ(both.phase, 1);
}

TEST_F(ScenePins, MoveAndLetGoInARun) {
  for (const char* filter : {"none", "{form: conserving, target: force}", "{lambda: 2}"}) {
    const cli::Scene scene = read(moved, filter);
    const cli::Simulation simulation(scene);
    const auto run =
        simulation.make_run(simulation.choose_step(), [k = 0]() mutable { return k < 16 ? 0.1 * k++ : HUGE_VAL; });
    const sim::KeyedMotion& motion = scene.bodies[0].pins[0].motion;
    const Eigen::MatrixX3d& rest = simulation.structure().rest_position;
    while (const auto sample = run->next()) {
      const sim::State& state = sample->state;
      for (const int i : {0, 1}) {
        const Eigen::Vector3d x = state.position.row(i), r = rest.row(i);
        EXPECT_LT((x - motion.at(state.time) * r).norm(), 1e-3) << state.time << ": exact at steps, a cubic between";
      }
      const double fallen = (state.position - rest).row(8).norm();
      if (state.time <= 0.5) {
        EXPECT_EQ(fallen, 0.0) << state.time;
      }
      if (state.time > 0.7) {
        EXPECT_GT(fallen, 0.02) << state.time;
      }
    }
  }
}

// Soft bodies take the same pins.
TEST(ScenePinsOfSoftBodies, MoveAndLetGo) {
  const test::SceneFolder folder;
  folder.write("block.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const cli::Scene scene = cli::read_scene(
      folder.scene("billow: 1\nduration: 1\nbodies: [{soft: {mesh: block.obj, pins: [{vertices: [2], until: 0.5, "
                   "motion: [{time: 0}, {time: 0.5, translate: [0, 0.3, 0]}]}]}}]\n"));
  const cli::Simulation simulation(scene);
  const auto solver = simulation.make_solver(simulation.choose_step());
  const double start = solver->state().position(2, 1);
  EXPECT_NEAR(solver->sample(0.5).position(2, 1), start + 0.3, 1e-3);
  EXPECT_LT(solver->sample(1.0).position(2, 1), start);
}

}  // namespace
}  // namespace billow
