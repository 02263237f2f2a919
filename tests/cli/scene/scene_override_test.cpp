// -D key.path=value.
#include <gtest/gtest.h>

#include "cli/scene/scene.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

using cli::Override;
using cli::read_scene;
using cli::Scene;

const sim::ClothOptions& cloth_of(const Scene& scene, std::size_t body) {
  return std::get<cli::ClothSpec>(scene.bodies[body].kind).options;
}

class SceneOverride : public testing::Test {
 protected:
  Scene with(const std::vector<Override>& overrides) const { return read_scene(file, overrides); }
  std::string error(const std::string& path, const std::string& value) const {
    return test::scene_error(file, {{path, value}});
  }

  test::SceneFolder folder;
  std::filesystem::path file = folder.scene(test::base_scene);
};

TEST_F(SceneOverride, ReplacesAValue) {
  EXPECT_EQ(with({{"duration", "0.5"}}).duration, 0.5);
  EXPECT_EQ(with({{"solver.filter.lambda", "3"}}).solver.filter->lambda, 3.0);
  EXPECT_EQ(with({{"render.size", "[100, 50]"}}).render.width, 100);
}

TEST_F(SceneOverride, FindsABodyByNumberAndByName) {
  EXPECT_EQ(cloth_of(with({{"bodies.0.cloth.mass", "5"}}), 0).mass, 5.0);
  EXPECT_EQ(cloth_of(with({{"bodies.sheet.cloth.mass", "6"}}), 0).mass, 6.0);
}

TEST_F(SceneOverride, MakesWhatIsMissing) {
  EXPECT_EQ(with({{"render.background.top", "'#000000'"}}).render.background.top, Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(with({{"bodies.0.cloth.transform.scale", "2"}}).bodies[0].mesh.position(8, 0), 2.0);
}

TEST_F(SceneOverride, TakesAWholeMapOrNone) {
  EXPECT_FALSE(with({{"solver.filter", "none"}}).solver.filter);
  EXPECT_FALSE(with({{"strip", "none"}}).strip);
  EXPECT_EQ(with({{"solver", "{method: rk4, step: 0.001}"}}).solver.step, 0.001);
}

TEST_F(SceneOverride, LetsTheLastOneWin) {
  EXPECT_EQ(with({{"duration", "1"}, {"duration", "3"}}).duration, 3.0);
  EXPECT_EQ(with({{"solver.filter", "none"}, {"solver.filter", "{lambda: 2}"}}).solver.filter->lambda, 2.0);
}

TEST_F(SceneOverride, ShowsInTheEffectiveSceneAndTheHash) {
  const Scene plain = with({}), changed = with({{"solver.safety", "0.5"}});
  EXPECT_NE(changed.hash, plain.hash);
  EXPECT_EQ(read_scene(folder.scene(changed.effective)).solver.safety, 0.5);
}

// An alias shares its node with the anchor; only the path of the override may change.
TEST_F(SceneOverride, LeavesAliasesAlone) {
  const auto two = folder.scene(
      "billow: 1\nbodies:\n  - name: one\n    cloth: &c {mesh: cloth.obj, mass: 1}\n  - name: two\n    cloth: *c\n");
  const Scene scene = read_scene(two, {{"bodies.two.cloth.mass", "2"}});
  EXPECT_EQ(cloth_of(scene, 0).mass, 1.0);
  EXPECT_EQ(cloth_of(scene, 1).mass, 2.0);
}

TEST_F(SceneOverride, SaysWhichOneIsWrong) {
  EXPECT_EQ(error("solver.stpe", "0.1"), "-D solver.stpe: unknown key 'stpe' in solver; did you mean 'step'?");
  EXPECT_EQ(error("solvr.step", "0.1"), "-D solvr.step: unknown key 'solvr' in the scene; did you mean 'solver'?");
  EXPECT_EQ(error("solver.step", "fast"), "-D solver.step: step must be auto, paper or a number, not 'fast'");
  EXPECT_EQ(error("render.size", "[100, 5]"),
            "-D render.size: height is 5 pixels; it must be at least 16 and at most 8192 pixels");
  EXPECT_EQ(error("duration", ""), "-D duration: there is nothing in it");
  EXPECT_EQ(error("duration", "[1"), "-D duration: not valid YAML: end of sequence flow not found");
  EXPECT_EQ(error("duration", "~"), "-D duration: duration has no value");
  EXPECT_EQ(error("duration", "\xff"), "-D duration: the value is not UTF-8 text");
  EXPECT_EQ(error("", "1"), "-D : a key is missing in the path");
  EXPECT_EQ(error("solver..step", "1"), "-D solver..step: a key is missing in the path");
  EXPECT_EQ(error("duration.x", "1"), "-D duration.x: duration is '2' (at scene.yaml:2:11) and has no keys");
  EXPECT_EQ(error("bodies.1.cloth.mass", "1"),
            "-D bodies.1.cloth.mass: bodies has one entry, 0; none is '1'; named: sheet");
  EXPECT_EQ(error("bodies.sheat.cloth.mass", "1"),
            "-D bodies.sheat.cloth.mass: bodies has one entry, 0; none is 'sheat'; did you mean 'sheet'?");
  EXPECT_EQ(error("bodies.0.texture", "no.png"), "-D bodies.0.texture: there is no texture file no.png");
}

}  // namespace
}  // namespace billow
