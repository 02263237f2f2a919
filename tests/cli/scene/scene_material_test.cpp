// Materials and densities as scenes say them: what they weigh, what is refused, and that scenes without them stay what
// they were.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/scene/material_text.h"
#include "sim/mesh/closed_surface.h"
#include "tests/support/mesh_files.h"
#include "tests/support/refined_meshes.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

using testing::HasSubstr;

class SceneMaterial : public testing::Test {
 protected:
  SceneMaterial() {
    folder_.write("squares.obj", test::mesh_file("obj", test::sheet(test::Weave::squares, 1.0, 1.0, 4)));
    folder_.write("triangles.obj", test::mesh_file("obj", test::sheet(test::Weave::cut_squares, 1.0, 1.0, 4)));
    folder_.write("ball.obj", test::mesh_file("obj", test::sphere(1)));
  }

  std::filesystem::path file(const std::string& body) const {
    return folder_.write("scene.yaml", "billow: 1\nbodies:\n  - {name: it, " + body + "}\n");
  }
  cli::Scene read(const std::string& body) const { return cli::read_scene(file(body)); }
  sim::Structure built(const std::string& body) const { return cli::build_structure(read(body)); }
  std::string error(const std::string& body) const { return test::scene_error(file(body)); }

  test::TemporaryFolder folder_;
};

TEST_F(SceneMaterial, DensityTimesAreaOrVolumeIsTheMass) {
  EXPECT_NEAR(built("cloth: {mesh: squares.obj, density: 0.3}").mass.sum(), 0.3, 1e-6);
  EXPECT_NEAR(built("cloth: {mesh: squares.obj, density: 0.3, transform: {scale: 2}}").mass.sum(), 1.2, 1e-5);
  EXPECT_NEAR(built("cloth: {mesh: squares.obj, fabric: denim, density: 0.3}").mass.sum(), 0.3, 1e-6);
  EXPECT_NEAR(built("soft: {mesh: ball.obj, density: 500}").mass.sum(), 500 * sim::enclosed_volume(test::sphere(1)),
              1e-2);
}

TEST_F(SceneMaterial, ReadsBackFromTheEffectiveScene) {
  for (const char* body : {"cloth: {mesh: squares.obj, density: 0.3, material: {stretch: 90, shear: 20, bend: 1e-5}}",
                           "cloth: {mesh: triangles.obj, model: choi_ko, material: {stretch: 90, bend: 1e-5}}",
                           "soft: {mesh: ball.obj, density: 500, material: {young: 2e4}}", "soft: {mesh: ball.obj}"}) {
    const cli::Scene scene = read(body);
    const sim::Structure structure = cli::build_structure(scene);
    const cli::Scene again = cli::read_scene(folder_.write("again.yaml", scene.effective));
    EXPECT_EQ(again.effective, scene.effective);
    const sim::Structure same = cli::build_structure(again);
    EXPECT_EQ(same.stiffness, structure.stiffness);
    EXPECT_EQ(same.rest_length, structure.rest_length);
    EXPECT_EQ(same.mass, structure.mass);
  }
}

TEST_F(SceneMaterial, SaysWhatCameOut) {
  const cli::Scene scene = read("cloth: {mesh: squares.obj, density: 0.3, material: {stretch: 80}}");
  const std::vector<std::string> lines = cli::material_lines(scene, cli::build_structure(scene));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(lines[0], HasSubstr("material: body it weighs 0.3 kg and has 72 springs of "));
  const cli::Scene plain = read("cloth: {mesh: squares.obj}");
  EXPECT_TRUE(cli::material_lines(plain, cli::build_structure(plain)).empty());
}

// The defaults of `stiffness`, spring by spring.
TEST_F(SceneMaterial, WithoutOneSpringsAreWhatTheyWere) {
  const sim::Structure cloth = built("cloth: {mesh: squares.obj}");
  for (int s = 0; s < cloth.springs(); ++s)
    EXPECT_EQ(cloth.stiffness(s), cloth.kind[s] == sim::SpringKind::structural ? 115.0
                                  : cloth.kind[s] == sim::SpringKind::shear    ? 80.0
                                                                               : 35.0);
}

TEST_F(SceneMaterial, StiffnessGoesWithTheModuli) {
  const sim::Structure once = built("soft: {mesh: ball.obj, material: {young: 1e3}}");
  const sim::Structure twice = built("soft: {mesh: ball.obj, material: {young: 2e3}}");
  EXPECT_LT((twice.stiffness - 2.0 * once.stiffness).norm(), 1e-9 * twice.stiffness.norm());
}

TEST_F(SceneMaterial, SaysWhatIsWrong) {
  EXPECT_EQ(error("cloth: {mesh: squares.obj, mass: 1, density: 1}"),
            "scene.yaml:3:61: density and mass both say what the body weighs; leave one of them out");
  EXPECT_EQ(error("soft: {mesh: ball.obj, mass: 1, density: 1}"),
            "scene.yaml:3:57: density and mass both say what the body weighs; leave one of them out");
  EXPECT_EQ(error("soft: {mesh: ball.obj, density: 0}"),
            "scene.yaml:3:48: density is 0 kg/m³; it must be above 0 and at most 1000000 kg/m³");
  EXPECT_EQ(error("cloth: {mesh: squares.obj, material: {stretch: 9}, stiffness: {bend: 1}}"),
            "scene.yaml:3:78: stiffness and material both say how hard the springs are; leave one of them out");
  EXPECT_EQ(error("cloth: {mesh: squares.obj, material: {stretch: 9}, buckling_rigidity: 1}"),
            "scene.yaml:3:86: buckling_rigidity and material both say how hard the springs are; leave one of them out");
  EXPECT_EQ(error("soft: {mesh: ball.obj, material: {young: 9}, stiffness: {max_eigenvalue: 1e4}}"),
            "scene.yaml:3:72: stiffness and material both say how hard the springs are; leave one of them out");
  EXPECT_EQ(error("cloth: {mesh: squares.obj, fabric: silk, material: {stretch: 9}}"),
            "scene.yaml:3:67: fabric and material both say what the cloth is made of; leave one of them out");
  EXPECT_EQ(error("cloth: {mesh: triangles.obj, material: {stretch: 9, shear: 1}}"),
            "scene.yaml:3:75: shear is between threads along the sides of quads, and the mesh has triangles; leave it "
            "out, and the cloth is alike in all directions, or make the mesh of quads");
  EXPECT_THAT(error("cloth: {mesh: squares.obj, material: {bend: 1}}"), HasSubstr("stretch"));
  EXPECT_THAT(error("soft: {mesh: ball.obj, material: {}}"), HasSubstr("young"));
  EXPECT_THAT(error("soft: {mesh: ball.obj, material: rubber}"), HasSubstr("material must be none or a map"));
  EXPECT_THAT(error("soft: {mesh: ball.obj, material: {stretch: 1}}"), HasSubstr("unknown key 'stretch' in material"));
}

}  // namespace
}  // namespace billow
