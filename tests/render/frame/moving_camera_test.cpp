// A camera that moves sees what a still one sees from there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/frame/mesh_renderer.h"
#include "render/frame/stage.h"
#include "render/image/camera_motion.h"
#include "render/image/compare.h"
#include "tests/support/drawn_sheet.h"

namespace billow::render {
namespace {

using test::DrawnSheet;
using test::wavy_sheet;

Settings turning() {
  Settings settings = test::sheet_settings();
  settings.camera.fitted = false;
  settings.camera.eye = {0.3, 0.2, 2.5}, settings.camera.look_at = {0.0, -0.1, 0.0};
  settings.camera.turn_period = 4.0;
  return settings;
}

// The velocity view has no lights, which stay with the first moment's camera.
TEST(MovingCamera, SeesWhatAStillOneSeesFromThere) {
  const DrawnSheet sheet = wavy_sheet();
  MeshRenderer moving(turning(), {sheet.body}, sheet.bounds);
  for (const double time : {0.7, 0.0, 1.3}) {
    Settings still = turning();
    still.camera = camera_at(still.camera, time);
    still.camera.turn_period = 0.0;
    const auto seen = std::get<Image>(moving.draw(View::velocity, {sheet.state}, Eigen::Vector3d::Zero(), time));
    EXPECT_EQ(seen.pixels, test::draw_sheet(sheet, View::velocity, still).pixels) << time;
  }
}

TEST(MovingCamera, LightsAndGroundStay) {
  const DrawnSheet sheet = wavy_sheet();
  MeshRenderer moving(turning(), {sheet.body}, sheet.bounds);
  Settings still = turning();
  still.camera.turn_period = 0.0;
  const auto at = [&](double time) {
    return std::get<Image>(moving.draw(View::textured, {sheet.state}, Eigen::Vector3d::Zero(), time));
  };
  const Image later = at(1.0), first = at(0.0);
  EXPECT_EQ(first.pixels, test::draw_sheet(sheet, View::textured, still).pixels);
  EXPECT_NE(first.pixels, later.pixels);
  EXPECT_LE(compare(at(4.0), first).max, 8);  // all the way round, but for rounding
}

// The same lights and ground for every frame, or shadows would swim as it moves.
TEST(MovingCamera, MovesNothingElseOfTheStage) {
  const Settings settings = turning();
  const DrawnSheet sheet = wavy_sheet();
  const Stage before = make_stage(settings, sheet.bounds.box);
  Stage after = before;
  set_camera(after, settings, sheet.bounds.box, camera_at(settings.camera, 1.0));
  EXPECT_NE(after.view_projection, before.view_projection);
  EXPECT_EQ(after.to_light, before.to_light);
  EXPECT_EQ(after.to_fill, before.to_fill);
  EXPECT_EQ(after.light_projection, before.light_projection);
  EXPECT_EQ(after.shadow_patch.centre, before.shadow_patch.centre);
}

// Of a body that stands still before a camera that turns: from this frame's place to the next one's.
TEST(MovingCamera, MotionVectorsCountItsMotion) {
  Settings settings = turning();
  settings.samples = 1;
  DrawnSheet sheet = test::flat_sheet();
  MeshRenderer renderer(settings, {sheet.body}, sheet.bounds);
  const double time = 0.5;
  const auto image = std::get<DataImage>(renderer.draw(View::data, {sheet.state}, Eigen::Vector3d::Zero(), time));
  const auto channel = [&](const std::string& name) -> const std::vector<float>& {
    return std::find_if(image.channels.begin(), image.channels.end(), [&](const auto& c) { return c.name == name; })
        ->value;
  };
  // A point of the sheet, through both cameras, by hand.
  const auto project = [&](const Camera& camera, const Eigen::Vector3d& place) {
    const Eigen::Vector3d back = (camera.eye - camera.look_at).normalized();
    const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(back).normalized(), up = back.cross(right);
    const Eigen::Vector3d way = place - camera.eye;
    const double focal = 0.5 * settings.height / std::tan(0.5 * camera.vertical_fov), depth = -way.dot(back);
    return Eigen::Vector2d(focal * way.dot(right) / depth, focal * way.dot(up) / depth);
  };
  const Camera now = camera_at(settings.camera, time), next = camera_at(settings.camera, time + 1.0 / settings.fps);
  int checked = 0;
  const Eigen::Vector3d places[] = {{0.1, 0.2, 0.0}, {-0.4, -0.3, 0.0}, {0.5, 0.0, 0.0}};
  for (const Eigen::Vector3d& place : places) {
    const Eigen::Vector2d pixel = project(now, place);
    const int x = static_cast<int>(std::floor(pixel.x() + 0.5 * settings.width));
    const int y = settings.height - 1 - static_cast<int>(std::floor(pixel.y() + 0.5 * settings.height));
    const std::size_t p = static_cast<std::size_t>(y) * settings.width + x;
    ASSERT_EQ(channel("A")[p], 1.0f);
    const Eigen::Vector2d motion = project(next, place) - pixel;
    EXPECT_NEAR(channel("motion.X")[p], motion.x(), 0.05);  // the pixel's middle is not the place itself
    EXPECT_NEAR(channel("motion.Y")[p], motion.y(), 0.05);
    ++checked;
  }
  EXPECT_EQ(checked, 3);
}

}  // namespace
}  // namespace billow::render
