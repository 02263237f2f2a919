// Levels in scenes: what may be said of them, and the ratio that they choose for themselves.
#include <gtest/gtest.h>

#include <string>

#include "base/error.h"
#include "cli/scene/filter_text.h"
#include "cli/scene/simulation.h"
#include "sim/limit/certificate.h"
#include "tests/support/mesh_files.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

class SceneLevels : public testing::Test {
 protected:
  SceneLevels() { folder_.write("sheet.obj", test::mesh_file("obj", test::quad_grid(12, 12))); }

  /// A sheet of 12 x 12 held at two corners, of k0 = `stiffness` [1/s^2], with `solver` in braces.
  std::filesystem::path sheet(const std::string& solver, const std::string& stiffness = "1e6",
                              const std::string& rest = "") const {
    return folder_.scene(
        "billow: 1\nduration: 2\nbodies: [{name: sheet, cloth: {mesh: sheet.obj, stiffness: "
        "{max_eigenvalue: " +
        stiffness + "}, pins: [{corner: top_left}, {corner: top_right}]" + rest + "}}]\nsolver: {" + solver + "}\n");
  }
  /// What makes the scene's simulation fail, the folder left out; "" for nothing.
  std::string error(const std::filesystem::path& file) const {
    const std::string read = test::scene_error(file), folder = folder_.path().string() + "/";
    if (!read.empty()) return read;
    const cli::Scene scene = cli::read_scene(file);
    try {
      const cli::Simulation simulation(scene);
    } catch (const InputError& error) {
      std::string message = error.what();
      if (const std::size_t at = message.find(folder); at != std::string::npos) message.erase(at, folder.size());
      return message;
    }
    return "";
  }

  test::SceneFolder folder_;
};

/// [s] for any shape, as the scene's filter allows it.
double any_shape_limit(const cli::Scene& scene, const cli::Simulation& simulation) {
  const sim::Linearisation bound = simulation.forces().bound(sim::Shapes::any).linearisation;
  const sim::StiffnessMatrix least_damping = simulation.forces().least_damping();
  return sim::certified_step({.structure = simulation.structure(),
                              .linearisation = bound,
                              .position = simulation.structure().rest_position,
                              .method = scene.solver.method,
                              .options = scene.solver.integrator,
                              .filter = simulation.filter_operator(),
                              .duration = scene.duration,
                              .least_damping = &least_damping})
      .step;
}

TEST_F(SceneLevels, FilterForcesAndChooseTheirRatioUnlessItIsGiven) {
  const cli::Scene chosen = cli::read_scene(sheet("filter: {kernel: levels}")),
                   given = cli::read_scene(sheet("filter: {kernel: levels, target: force, ratio: 4.5}"));
  EXPECT_EQ(chosen.solver.filter->kernel, sim::FilterKernel::levels);
  EXPECT_EQ(chosen.solver.filter->target, sim::FilterTarget::force);
  EXPECT_TRUE(chosen.solver.levels_choose);
  EXPECT_FALSE(given.solver.levels_choose);
  EXPECT_EQ(given.solver.filter->ratio, 4.5);
}

TEST_F(SceneLevels, ReadBackFromTheEffectiveScene) {
  for (const std::string filter :
       {"{kernel: levels}", "{kernel: levels, ratio: auto}", "{kernel: levels, ratio: 4.5}"}) {
    const cli::Scene scene = cli::read_scene(sheet("filter: " + filter));
    const cli::Scene again = cli::read_scene(folder_.write("again.yaml", scene.effective));
    EXPECT_EQ(again.effective, scene.effective);
    EXPECT_EQ(again.solver.levels_choose, scene.solver.levels_choose) << filter;
    EXPECT_EQ(again.solver.filter->ratio, scene.solver.filter->ratio) << filter;
  }
}

// At the value that is out of place.
TEST_F(SceneLevels, RefuseWhatBelongsToOtherKernels) {
  for (const auto& [key, value] : {std::pair<std::string, std::string>{"lambda", "1"},
                                   {"lambda", "\"1 + x\""},
                                   {"lambda_keys", "[[0, 1]]"},
                                   {"form", "conserving"},
                                   {"neighbours", "radius"},
                                   {"radius", "2"},
                                   {"distances", "current"},
                                   {"passes", "2"}})
    EXPECT_EQ(error(sheet("filter: {kernel: levels, " + key + ": " + value + "}")),
              "scene.yaml:4:" + std::to_string(37 + key.size()) + ": '" + key +
                  "' means nothing here: levels are set by their 'ratio' alone");
  for (const std::string kernel : {"", "kernel: exponential, ", "kernel: gaussian, "})
    EXPECT_EQ(error(sheet("filter: {" + kernel + "ratio: 2}")),
              "scene.yaml:4:" + std::to_string(26 + kernel.size()) +
                  ": 'ratio' means nothing here: it belongs to 'kernel: levels'");
}

TEST_F(SceneLevels, RefuseVelocitiesImplicitSchemesAndRatiosOutOfRange) {
  EXPECT_EQ(error(sheet("filter: {kernel: levels, target: velocity}")),
            "scene.yaml:4:43: levels filter forces: of velocities they would damp every fold; use 'target: force'");
  for (const std::string method : {"imex", "backward_euler"})
    EXPECT_EQ(error(sheet("filter: {kernel: levels}, method: " + method)),
              "scene.yaml:4:18: levels need an explicit method, and " + method +
                  " is implicit; use fb_euler, or filter nothing");
  EXPECT_EQ(error(sheet("filter: {kernel: levels, ratio: 0.9}")),
            "scene.yaml:4:42: ratio is 0.9; it must be at least 1 and at most 1000");
  EXPECT_EQ(error(sheet("filter: {kernel: levels, ratio: much}")),
            "scene.yaml:4:42: ratio must be auto or a number, not 'much'");
}

TEST_F(SceneLevels, AllowAGivenStepAndHardlyMore) {
  for (const std::string method : {"fb_euler", "verlet", "rk4"})
    for (const std::string damping : {"", ", damping: {model: projected, coefficient: 0.02, friction: 1e-4}"})
      for (const double step : {0.004, 0.012}) {
        SCOPED_TRACE(testing::Message() << method << damping << ", " << step);
        const cli::Scene scene = cli::read_scene(
            sheet("method: " + method + ", step: " + std::to_string(step) + ", safety: 0.8, filter: {kernel: levels}",
                  "1e6", damping));
        const cli::Simulation simulation(scene);
        ASSERT_TRUE(simulation.filter());
        const double allowed = 0.8 * any_shape_limit(scene, simulation);
        EXPECT_GE(allowed, step * (1.0 - 1.01e-3));
        EXPECT_LE(allowed, step * 1.02);
      }
}

TEST_F(SceneLevels, ChooseStepsOfEightMillisecondsWhereNoneIsGiven) {
  const cli::Scene scene = cli::read_scene(sheet("step: auto, filter: {kernel: levels, ratio: auto}"));
  const cli::Simulation simulation(scene);
  ASSERT_TRUE(simulation.filter());
  const cli::StepChoice choice = simulation.choose_step();
  EXPECT_NEAR(choice.k0.value, 1e6, 1e3);
  EXPECT_NEAR(choice.step, 0.008, 1e-4);
  EXPECT_EQ(choice.bound, "certified for any shape");
  EXPECT_LT(simulation.filter()->ratio, 10.0);
  EXPECT_GT(simulation.filter()->ratio, 3.0);
  EXPECT_TRUE(cli::filter_text(scene, simulation).starts_with("levels ×")) << cli::filter_text(scene, simulation);
  const std::vector<std::string> lines = cli::level_lines(simulation);
  ASSERT_GE(lines.size(), 2u);
  EXPECT_TRUE(lines[0].starts_with("sheet, level 0: 144 particles, γ = 0.")) << lines[0];
  EXPECT_TRUE(lines[1].starts_with("sheet, level 1: 36 nodes, γ = 0.")) << lines[1];
}

// Beyond ten times the unfiltered step levels slow what one sees: k0 = 1e8 would need 66.
TEST_F(SceneLevels, ChooseNoMoreThanTenTimesTheUnfilteredStep) {
  const cli::Scene scene = cli::read_scene(sheet("filter: {kernel: levels}", "1e8")),
                   bare = cli::read_scene(sheet("filter: none", "1e8"));
  const cli::Simulation simulation(scene), unfiltered(bare);
  EXPECT_EQ(simulation.filter()->ratio, 10.0);
  const double step = simulation.choose_step().step;
  EXPECT_LT(step, 0.003);
  EXPECT_NEAR(step, 0.9 * 10.0 * any_shape_limit(bare, unfiltered), 0.01 * step);
}

TEST_F(SceneLevels, AreNotTakenWhereTheStepNeedsNone) {
  for (const std::string solver : {"filter: {kernel: levels}", "step: 0.001, filter: {kernel: levels}"}) {
    const cli::Scene scene = cli::read_scene(sheet(solver, solver[0] == 's' ? "1e6" : "1e4"));
    const cli::Simulation simulation(scene);
    EXPECT_FALSE(simulation.filter());
    EXPECT_EQ(simulation.filter_operator(), nullptr);
    EXPECT_EQ(cli::filter_text(scene, simulation), "none, as no levels are needed for this step");
    EXPECT_TRUE(cli::level_lines(simulation).empty());
  }
}

TEST_F(SceneLevels, SayWhereNoneAllowTheStep) {
  const std::string too_much = error(sheet("filter: {kernel: levels, ratio: 500}"));
  EXPECT_TRUE(too_much.starts_with("scene.yaml:4:42: levels of 'sheet' allow at most ")) << too_much;
  const std::string too_long = error(sheet("step: 0.5, filter: {kernel: levels}"));
  EXPECT_TRUE(too_long.starts_with("scene.yaml:4:29: levels of 'sheet' allow at most ")) << too_long;
  // Friction is felt by every level alike: 2 m / c is below this step.
  EXPECT_EQ(
      error(sheet("step: 0.01, filter: {kernel: levels}", "1e5", ", damping: {friction: 0.3}")),
      "scene.yaml:4:30: no levels allow a step of 0.01 s, as damping or friction bounds it too; take a smaller one, "
      "or 'step: auto'");
  EXPECT_EQ(error(sheet("method: forward_euler, filter: {kernel: levels}")),
            "scene.yaml:4:41: forward_euler grows at every step here, which no levels change; use another method");
}

}  // namespace
}  // namespace billow
