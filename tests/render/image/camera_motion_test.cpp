// Cameras that move: through their keys, smoothly, and around.
#include "render/image/camera_motion.h"

#include <gtest/gtest.h>

#include <numbers>

namespace billow::render {
namespace {

Camera keyed() {
  Camera camera;
  camera.keys = {{1.0, {0, 0, 3}, {0, 0, 0}, 0.7},
                 {2.0, {1, 1, 3}, {0, 0.5, 0}, 0.7},
                 {4.0, {5, 0, 3}, {0, 0.5, 0}, 0.4},
                 {5.0, {6, -1, 2}, {0, 0, 0}, 0.4}};
  return camera;
}

TEST(CameraMotion, GoesThroughItsKeysAndStandsStillOutside) {
  const Camera camera = keyed();
  for (const CameraKey& key : camera.keys) {
    const Camera now = camera_at(camera, key.time);
    EXPECT_EQ(now.eye, key.eye);
    EXPECT_EQ(now.look_at, key.look_at);
    EXPECT_EQ(now.vertical_fov, key.vertical_fov);
  }
  EXPECT_EQ(camera_at(camera, 0.0).eye, camera.keys.front().eye);
  EXPECT_EQ(camera_at(camera, 99.0).eye, camera.keys.back().eye);
}

// No kink: the slopes on both sides of every moment agree; and no number leaves the range of its two keys.
TEST(CameraMotion, IsSmoothAndDoesNotOvershoot) {
  const Camera camera = keyed();
  const double h = 1e-5;
  for (double t = 0.5; t <= 5.5; t += 0.25) {
    const auto slope = [&](double from, double to) {
      return Eigen::Vector3d((camera_at(camera, to).eye - camera_at(camera, from).eye) / (to - from));
    };
    EXPECT_LT((slope(t - h, t) - slope(t, t + h)).norm(), 1e-3) << t;
  }
  for (std::size_t k = 0; k + 1 < camera.keys.size(); ++k)
    for (double share = 0.0; share <= 1.0; share += 0.05) {
      const CameraKey &a = camera.keys[k], &b = camera.keys[k + 1];
      const Camera now = camera_at(camera, a.time + share * (b.time - a.time));
      EXPECT_TRUE((now.eye.array() >= a.eye.cwiseMin(b.eye).array() - 1e-12).all()) << k;
      EXPECT_TRUE((now.eye.array() <= a.eye.cwiseMax(b.eye).array() + 1e-12).all()) << k;
    }
}

TEST(CameraMotion, TurnsAroundWhatItLooksAt) {
  Camera camera;
  camera.eye = {1.0, 2.0, 6.0}, camera.look_at = {1.0, 0.0, 3.0};
  camera.turn_period = 8.0;
  EXPECT_TRUE(camera_at(camera, 0.0).eye.isApprox(camera.eye));
  EXPECT_TRUE(camera_at(camera, 2.0).eye.isApprox(Eigen::Vector3d(4.0, 2.0, 3.0), 1e-12));  // a quarter
  EXPECT_TRUE(camera_at(camera, 4.0).eye.isApprox(Eigen::Vector3d(1.0, 2.0, 0.0), 1e-12));
  EXPECT_TRUE(camera_at(camera, 8.0).eye.isApprox(camera.eye, 1e-12));
}

}  // namespace
}  // namespace billow::render
