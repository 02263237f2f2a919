// Fabrics and limits of strain as scenes say them: what a fabric fills in, what wins over it, what is refused, and that
// a run keeps to a limit.
#include <gtest/gtest.h>

#include <cmath>

#include "cli/scene/fabric.h"
#include "cli/scene/simulation.h"
#include "sim/body/stretch.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

class SceneFabric : public testing::Test {
 protected:
  // A cloth of one square metre, edges half a metre long.
  std::filesystem::path file(const std::string& cloth, const std::string& body = "") const {
    return folder_.scene("billow: 1\nbodies:\n  - {name: sheet, cloth: {mesh: cloth.obj, " + cloth + "}" + body +
                         "}\n");
  }
  cli::Scene read(const std::string& cloth, const std::string& body = "") const {
    return cli::read_scene(file(cloth, body));
  }
  std::string error(const std::string& cloth) const { return test::scene_error(file(cloth)); }
  static const cli::ClothSpec& cloth_of(const cli::Scene& scene) {
    return std::get<cli::ClothSpec>(scene.bodies[0].kind);
  }

  test::SceneFolder folder_;
};

TEST_F(SceneFabric, FillsInWhatTheClothLeavesOut) {
  const cli::Fabric& denim = cli::fabric("denim");
  const cli::Scene scene = read("fabric: denim", ", contact: {}");
  const sim::ClothOptions& options = cloth_of(scene).options;
  EXPECT_NEAR(options.mass, denim.area_density, 1e-12);
  EXPECT_EQ(options.structural, cli::structural_stiffness(denim));
  EXPECT_EQ(options.shear, denim.shear);
  EXPECT_NEAR(options.bend, cli::bend_stiffness(denim, 0.5), 1e-12 * options.bend);
  EXPECT_EQ(scene.bodies[0].contact->thickness, denim.thickness);
  EXPECT_EQ(scene.bodies[0].contact->friction, denim.friction);
}

TEST_F(SceneFabric, GivesWayToWhatTheClothSays) {
  const cli::Scene scene = read("fabric: silk, mass: 3, stiffness: {structural: 90, bend: 2}, buckling_rigidity: 0.1",
                                ", contact: {friction: 0.7}");
  const cli::ClothSpec& cloth = cloth_of(scene);
  EXPECT_EQ(cloth.options.mass, 3.0);
  EXPECT_EQ(cloth.options.structural, 90.0);
  EXPECT_EQ(cloth.options.shear, cli::fabric("silk").shear);
  EXPECT_EQ(cloth.options.bend, 2.0);
  EXPECT_EQ(cloth.options.buckling_rigidity, 0.1);
  EXPECT_EQ(scene.bodies[0].contact->friction, 0.7);
  EXPECT_EQ(scene.bodies[0].contact->thickness, cli::fabric("silk").thickness);
}

TEST_F(SceneFabric, WeighsByTheMeshAsItIsPlaced) {
  const cli::Scene scene = read("fabric: wool, transform: {scale: 2}");
  EXPECT_NEAR(cloth_of(scene).options.mass, 4.0 * cli::fabric("wool").area_density, 1e-12);
}

TEST_F(SceneFabric, ReadsBackFromTheEffectiveScene) {
  for (const char* cloth : {"fabric: cotton", "fabric: leather, mass: 2, strain_limit: 0.05", "strain_limit: none"}) {
    const cli::Scene scene = read(cloth);
    const cli::Scene again = cli::read_scene(folder_.scene(scene.effective));
    EXPECT_EQ(again.effective, scene.effective);
    EXPECT_EQ(cloth_of(again).options.mass, cloth_of(scene).options.mass);
    EXPECT_EQ(cloth_of(again).options.bend, cloth_of(scene).options.bend);
    EXPECT_EQ(cloth_of(again).strain_limit, cloth_of(scene).strain_limit);
  }
}

TEST_F(SceneFabric, SaysWhatIsWrong) {
  EXPECT_EQ(error("fabric: coton"), "scene.yaml:3:52: unknown fabric 'coton'; did you mean 'cotton'?");
  EXPECT_EQ(error("mass: fabric"),
            "scene.yaml:3:50: mass is left to the fabric, and the cloth has none; give it one, such as 'fabric: "
            "cotton', or a number here");
  EXPECT_EQ(error("stiffness: {bend: fabric}"),
            "scene.yaml:3:62: bend is left to the fabric, and the cloth has none; give it one, such as 'fabric: "
            "cotton', or a number here");
  EXPECT_EQ(error("strain_limit: 0"), "scene.yaml:3:58: strain_limit is 0; it must be above 0 and at most 10");
  EXPECT_EQ(error("strain_limit: 10 %"), "scene.yaml:3:58: strain_limit must be none or a number, not '10 %'");
}

TEST_F(SceneFabric, LimitsWhatARunStretches) {
  const std::string weak = "mass: 1, stiffness: {structural: 10, shear: 7, bend: 0}, pins: [{corner: top_left}]";
  double stretch[2];
  for (const bool limited : {false, true}) {
    const cli::Scene scene = read(weak + (limited ? ", strain_limit: 0.1" : ""));
    const cli::Simulation simulation(scene);
    cli::StepChoice choice;
    choice.step = 1e-3;
    const auto solver = simulation.make_solver(choice);
    double most = 0.0;
    while (solver->state().time < 1.0) {
      solver->advance();
      most = std::max(most, sim::stretch_of(simulation.structure(), solver->state()).largest);
    }
    stretch[limited] = most;
  }
  EXPECT_GT(stretch[false], 1.0);
  EXPECT_LT(stretch[true], 0.11);
}

// Bending a sheet of square cells along its edges takes the fabric's energy where folds have a radius of 2 cm.
TEST(Fabric, BendsAsItsRigiditySays) {
  for (const cli::Fabric& fabric : cli::fabrics()) {
    const double edge = 0.02, curvature = 50.0, turn = curvature * edge;
    const double shorter = 2.0 * edge * (1.0 - std::cos(0.5 * turn));
    const double spring = 0.5 * cli::bend_stiffness(fabric, edge) * shorter * shorter;
    const double sheet = 0.5 * fabric.bend * curvature * curvature * edge * edge;
    EXPECT_NEAR(spring / sheet, 1.0, 0.05) << fabric.name << ": 1 - cos is half the square, to a twelfth of it";
  }
}

// A strip of square cells that is pulled: edges k and two diagonals K, its width free.
TEST(Fabric, StretchesAsItsModulusSays) {
  for (const cli::Fabric& fabric : cli::fabrics()) {
    const double k = cli::structural_stiffness(fabric), diagonal = fabric.shear;
    EXPECT_NEAR(k + diagonal - diagonal * diagonal / (k + diagonal), fabric.stretch, 1e-9 * fabric.stretch)
        << fabric.name;
    EXPECT_GT(k, 0.0) << fabric.name;
  }
}

}  // namespace
}  // namespace billow
