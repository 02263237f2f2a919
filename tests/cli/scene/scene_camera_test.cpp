// Cameras that move, and pictures without a background, in scenes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/scene/scene.h"
#include "tests/support/scene_files.h"

namespace billow {
namespace {

using testing::HasSubstr;

class SceneCamera : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& render) const {
    return folder_.scene("billow: 1\nbodies: [{cloth: {mesh: cloth.obj}}]\nrender: {" + render + "}\n");
  }
  // What is read, and read again from what it was written down as.
  render::Settings read(const std::string& render) const {
    const cli::Scene scene = cli::read_scene(file(render));
    const cli::Scene again = cli::read_scene(folder_.scene(scene.effective));
    EXPECT_EQ(again.hash, scene.hash);
    EXPECT_EQ(again.render.camera.keys.size(), scene.render.camera.keys.size());
    EXPECT_EQ(again.render.background.none, scene.render.background.none);
    EXPECT_EQ(again.render.shadow_only, scene.render.shadow_only);
    return scene.render;
  }
  std::string error(const std::string& render) const { return test::scene_error(file(render)); }

  test::SceneFolder folder_;
};

TEST_F(SceneCamera, HasKeys) {
  const render::Camera camera =
      read(
          "camera: {fov: 90, keys: [{time: 0, eye: [0, 0, 3], look_at: [0, 0, 0]}, {time: 2, eye: [3, 0, 0], "
          "look_at: [0, 1, 0], fov: 45}]}")
          .camera;
  ASSERT_EQ(camera.keys.size(), 2u);
  EXPECT_FALSE(camera.fitted);
  EXPECT_NEAR(camera.keys[0].vertical_fov, std::acos(0.0), 1e-12);
  EXPECT_NEAR(camera.keys[1].vertical_fov, 0.5 * std::acos(0.0), 1e-12);
  EXPECT_EQ(camera.keys[1].eye, Eigen::Vector3d(3, 0, 0));
  EXPECT_TRUE(read("camera: fit").camera.keys.empty());
}

TEST_F(SceneCamera, IsATurntable) {
  const render::Camera fitted = read("camera: {turntable: 6}").camera;
  EXPECT_EQ(fitted.turn_period, 6.0);
  EXPECT_TRUE(fitted.fitted);
  EXPECT_EQ(read("camera: {eye: [0, 0, 3], look_at: [0, 0, 0]}").camera.turn_period, 0.0);
}

TEST_F(SceneCamera, SaysWhatIsWrong) {
  const std::string first = "{time: 1, eye: [0, 0, 3], look_at: [0, 0, 0]}";
  EXPECT_THAT(error("camera: {keys: [" + first + ", {time: 1, eye: [1, 0, 3], look_at: [0, 0, 0]}]}"),
              HasSubstr("keys[1] is no later than the one before it; sort the keys by time"));
  EXPECT_THAT(error("camera: {eye: [0, 0, 3], look_at: [0, 0, 0], keys: [" + first + "]}"),
              HasSubstr("leave out eye and look_at"));
  EXPECT_THAT(error("camera: {keys: [" + first + ", {time: 2, eye: [0, 0, -3], look_at: [0, 0, 0]}]}"),
              HasSubstr("the camera's eye comes to what it looks at"));
  EXPECT_THAT(error("camera: {keys: [{time: 1, eye: [0, 0, 3]}]}"), HasSubstr("look_at"));
  EXPECT_THAT(error("camera: {turntable: 0}"), HasSubstr("turntable is 0 s; it must be above 0"));
  EXPECT_THAT(error("camera: {turntabel: 6}"), HasSubstr("did you mean 'turntable'?"));
}

TEST_F(SceneCamera, PicturesCanHaveNoBackground) {
  EXPECT_TRUE(read("background: none").background.none);
  const render::Settings shadow = read("background: none, ground: shadow_only");
  EXPECT_TRUE(shadow.shadow_only);
  EXPECT_TRUE(shadow.ground);
  EXPECT_TRUE(read("background: none, ground: {height: -1, shadow_only: true}").shadow_only);
  EXPECT_TRUE(read("background: none, ground: {height: -1, collide: true, shadow_only: true}").shadow_only);
  EXPECT_FALSE(read("background: '#112233'").background.none);
  EXPECT_THAT(error("ground: shadow_only"), HasSubstr("needs 'background: none'"));
}

}  // namespace
}  // namespace billow
