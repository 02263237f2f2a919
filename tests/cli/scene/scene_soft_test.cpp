// Soft bodies in scenes: what is read, what is refused, and that every command's machinery takes them.
#include <gtest/gtest.h>

#include "cli/drawn/drawn_scene.h"
#include "cli/run/strip_rows.h"
#include "cli/scene/simulation.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

constexpr const char* block = R"(v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 3 4 8 7
f 1 5 8 4
f 2 3 7 6
)";

class SceneSoft : public testing::Test {
 protected:
  SceneSoft() { folder_.write("block.obj", block); }
  cli::Scene read(const std::string& soft, const std::string& rest = "") const {
    return cli::read_scene(folder_.scene("billow: 1\nbodies: [{soft: {" + soft + "}}]\n" + rest));
  }
  std::string error(const std::string& body) const {
    return test::scene_error(folder_.scene("billow: 1\nbodies: [{" + body + "}]\n"));
  }

  test::SceneFolder folder_;
};

TEST_F(SceneSoft, IsReadWithItsOwnDefaults) {
  const sim::SoftBodyOptions soft =
      std::get<cli::SoftSpec>(read("mesh: block.obj, stiffness: {interior: 7}, pins: [{vertices: [3]}]").bodies[0].kind)
          .options;
  EXPECT_EQ(soft.interior, 7.0);
  EXPECT_EQ(soft.surface.structural, 200.0);
  EXPECT_EQ(soft.surface.mass, 1.0);
  EXPECT_EQ(soft.surface.pinned, std::vector<int>{3});
  EXPECT_EQ(soft.stiffness_factor.size(), 0);
}

// Formulas see where the transform has put the particles.
TEST_F(SceneSoft, VariesItsMaterialByFormulas) {
  const cli::Scene scene =
      read("mesh: block.obj, transform: {translate: [0, 10, 0]}, variation: {stiffness: 1 + y, mass: \"2 - x\"}");
  const sim::SoftBodyOptions& soft = std::get<cli::SoftSpec>(scene.bodies[0].kind).options;
  EXPECT_EQ(soft.stiffness_factor, (Eigen::VectorXd(8) << 11, 11, 12, 12, 11, 11, 12, 12).finished());
  EXPECT_EQ(soft.mass_factor, (Eigen::VectorXd(8) << 2, 1, 1, 2, 2, 1, 1, 2).finished());
}

TEST_F(SceneSoft, ReadsBackFromTheEffectiveScene) {
  const cli::Scene scene = read("mesh: block.obj, variation: {stiffness: \"1 + (x > 0.5)\"}, pins: [{vertices: [0]}]");
  const cli::Scene again = cli::read_scene(folder_.write("again.yaml", scene.effective));
  EXPECT_EQ(again.effective, scene.effective);
  EXPECT_EQ(again.hash, scene.hash);
}

TEST_F(SceneSoft, IsRefusedWithThePlace) {
  EXPECT_EQ(error("soft: {mesh: block.obj}, fish: {}"),
            "scene.yaml:2:42: a body is of one kind, and this one has 'soft' and 'fish'; make it two bodies");
  EXPECT_EQ(error("soft: {mesh: block.obj, model: choi_ko}").substr(0, 41),
            "scene.yaml:2:35: unknown key 'model' in s");
  EXPECT_EQ(error("soft: {mesh: block.obj, variation: {mass: x}}"),
            "scene.yaml:2:53: the variation of mass must be above 0 everywhere; at vertex 0 (0, 0, 0) it is 0");
  EXPECT_EQ(error("soft: {mesh: block.obj, variation: {stiffness: 1 +}}").substr(0, 54),
            "scene.yaml:2:58: in the formula '1 +', at its characte");
}

TEST_F(SceneSoft, NeedsAClosedMesh) {
  const cli::Scene scene = read("mesh: cloth.obj");
  try {
    cli::build_structure(scene);
    FAIL() << "a cloth is no solid";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("scene.yaml:2:24: the edge between the vertices 0"), std::string::npos)
        << error.what();
  }
}

// Beside a cloth, filtered, with a strip: the step is certified, and the run moves both.
TEST_F(SceneSoft, RunsBesideACloth) {
  const cli::Scene scene = cli::read_scene(folder_.scene(R"(billow: 1
bodies:
  - soft: {mesh: block.obj, damping: {coefficient: 0.1}}
  - cloth: {mesh: cloth.obj}
solver: {filter: {target: force, form: conserving}}
strip: {}
)"));
  const cli::Simulation simulation(scene);
  const cli::StepChoice choice = simulation.choose_step();
  EXPECT_GT(choice.step, 0.0);
  const sim::State state = simulation.make_solver(choice)->sample(0.5);
  // FB Euler in steps of h: g t (t + h) / 2.
  const double fallen = -0.5 * 9.81 * 0.5 * (0.5 + choice.step);
  EXPECT_NEAR((state.position - simulation.structure().rest_position).col(1).mean(), fallen, 0.01);
  EXPECT_EQ(cli::StripRows(scene, simulation.structure()).of(state.velocity).rows(), 8 + 9);
  EXPECT_EQ(cli::DrawnScene(scene, simulation).surfaces(state).size(), 2u);
}

}  // namespace
}  // namespace billow
