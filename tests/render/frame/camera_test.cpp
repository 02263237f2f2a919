#include "render/frame/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/frame/stage.h"
#include "render/gl/pixel_box.h"

namespace billow::render {
namespace {

Eigen::Vector3d projected(const Eigen::Matrix4d& view_projection, const Eigen::Vector3d& point) {
  return (view_projection * point.homogeneous()).hnormalized();
}

Eigen::Vector3d corner(const Eigen::AlignedBox3d& box, int i) {
  return box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
}

const Eigen::AlignedBox3d boxes[] = {
    {Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1)},          // a cube
    {Eigen::Vector3d(-0.5, -1, -2), Eigen::Vector3d(0.5, 0, 1)},      // deep
    {Eigen::Vector3d(-50, 3, -1), Eigen::Vector3d(50, 4, 1)},         // wide, large, off centre
    {Eigen::Vector3d(2, 0.001, 2), Eigen::Vector3d(2.01, 0.5, 2.01)}  // slender
};

TEST(FitCamera, PutsTheWholeBoxInsideTheFrameAndTouchesItsMargin) {
  for (const auto& box : boxes)
    for (const double aspect : {16.0 / 9.0, 1.0, 0.5}) {
      const Camera camera = fit_camera({.fitted = true}, box, aspect);
      const Eigen::Matrix4d clip = perspective(camera.vertical_fov, aspect, 1e-3, 1e3) * view_matrix(camera);
      double reach = 0.0;
      for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d p = projected(clip, corner(box, i));
        EXPECT_LT(p.z(), 1.0);
        EXPECT_GT(p.z(), -1.0);
        reach = std::max(reach, p.head<2>().lpNorm<Eigen::Infinity>());
      }
      EXPECT_LT(reach, 0.95);
      EXPECT_GT(reach, 0.85);  // as near as the margin allows
    }
}

// The corners of the frame, seen at the distance of look_at, touch the box from within.
TEST(FramedBox, HoldsWhatTheCameraShowsAroundItsTarget) {
  for (const auto& eye : {Eigen::Vector3d(0, 0, 4), Eigen::Vector3d(1.1, 0.05, 3.3), Eigen::Vector3d(0.1, 5, 0)}) {
    const Camera camera{.eye = eye, .look_at = {0.1, -0.6, 0}, .vertical_fov = 0.6};
    const double aspect = 16.0 / 9.0;
    const Eigen::AlignedBox3d box = framed_box(camera, aspect);
    const Eigen::Matrix4d clip = perspective(camera.vertical_fov, aspect, 1e-2, 1e2) * view_matrix(camera);
    const double depth = projected(clip, camera.look_at).z();
    Eigen::AlignedBox3d shown;
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0})
        shown.extend((clip.inverse() * Eigen::Vector3d(x, y, depth).homogeneous()).hnormalized());
    EXPECT_TRUE(box.center().isApprox(camera.look_at, 1e-9));
    const Eigen::AlignedBox3d widened(box.min().array() - 1e-9, box.max().array() + 1e-9);
    EXPECT_TRUE(widened.contains(shown));
    EXPECT_LT(box.sizes().maxCoeff(), 2.0 * shown.sizes().maxCoeff());
  }
}

TEST(FitCamera, LooksFromTheFrontAndSlightlyFromAbove) {
  const Camera camera = fit_camera({.fitted = true}, boxes[0], 1.5);
  const Eigen::Vector3d back = (camera.eye - camera.look_at).normalized();
  EXPECT_GT(back.z(), 0.8);
  EXPECT_GT(back.x(), 0.1);
  EXPECT_GT(back.y(), 0.1);
  EXPECT_LT(back.y(), 0.5);
}

TEST(FitCamera, StandsAPointAndNothingAtAll) {
  for (const Eigen::AlignedBox3d& box : {Eigen::AlignedBox3d(Eigen::Vector3d(1, 2, 3)), Eigen::AlignedBox3d()}) {
    const Camera camera = fit_camera({.fitted = true}, box, 1.0);
    EXPECT_TRUE(camera.eye.allFinite());
    EXPECT_GT((camera.eye - camera.look_at).norm(), 0.0);
  }
}

TEST(ViewMatrix, IsRigidAndLooksAlongMinusZ) {
  Camera camera;
  camera.eye = {1, 2, 3};
  for (const Eigen::Vector3d& target :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, -5, 3), Eigen::Vector3d(1, 9, 3)}) {
    camera.look_at = target;  // the last two are straight down and straight up
    const Eigen::Matrix4d view = view_matrix(camera);
    const Eigen::Matrix3d rotation = view.topLeftCorner(3, 3);
    EXPECT_TRUE(rotation.isUnitary(1e-12));
    EXPECT_NEAR(rotation.determinant(), 1.0, 1e-12);
    const Eigen::Vector3d seen = (view * target.homogeneous()).head<3>();
    EXPECT_TRUE(seen.isApprox(Eigen::Vector3d(0, 0, -(target - camera.eye).norm()), 1e-12));
  }
}

TEST(Perspective, MapsTheFrustumOntoTheClipCube) {
  const double fov = 0.7, aspect = 1.6, t = std::tan(0.35);
  const Eigen::Matrix4d clip = perspective(fov, aspect, 0.5, 20.0);
  EXPECT_TRUE(projected(clip, {0.5 * t * aspect, 0.5 * t, -0.5}).isApprox(Eigen::Vector3d(1, 1, -1), 1e-12));
  EXPECT_TRUE(projected(clip, {-20 * t * aspect, 20 * t, -20}).isApprox(Eigen::Vector3d(-1, 1, 1), 1e-12));
}

TEST(Orthographic, MapsTheBoxOntoTheClipCube) {
  const Eigen::Matrix4d clip = orthographic({Eigen::Vector3d(1, 2, -9), Eigen::Vector3d(3, 8, -4)});
  EXPECT_TRUE(projected(clip, {1, 2, -4}).isApprox(Eigen::Vector3d(-1, -1, -1), 1e-12));
  EXPECT_TRUE(projected(clip, {3, 8, -9}).isApprox(Eigen::Vector3d(1, 1, 1), 1e-12));
}

TEST(Stage, HoldsTheBodiesInTheLightAndTheirShadowsInThePatch) {
  for (const auto& box : boxes) {
    Settings settings;
    settings.camera.fitted = true;
    const Stage stage = make_stage(settings, box);
    EXPECT_LT(stage.ground_height, box.min().y());
    EXPECT_GT(stage.to_light.y(), 0.3);
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d p = corner(box, i);
      EXPECT_LE(projected(stage.light_projection, p).lpNorm<Eigen::Infinity>(), 1.0);
      const Eigen::Vector3d hit = p - stage.to_light * ((p.y() - stage.ground_height) / stage.to_light.y());
      const Eigen::Vector3d from_centre = hit - stage.shadow_patch.centre;
      const auto& [centre, u, v] = stage.shadow_patch;
      EXPECT_LT(std::abs(from_centre.dot(u)) / u.squaredNorm(), 1.0);
      EXPECT_LT(std::abs(from_centre.dot(v)) / v.squaredNorm(), 1.0);
    }
  }
}

TEST(Stage, SeesTheDrawnGroundToItsCorners) {
  for (const auto& box : boxes) {
    Settings settings;
    settings.camera.fitted = true;
    const Stage stage = make_stage(settings, box);
    const double half_side = ground_extent * stage.radius;
    for (const double x : {-half_side, half_side})
      for (const double z : {-half_side, half_side}) {
        const Eigen::Vector3d corner = stage.shadow_patch.centre + Eigen::Vector3d(x, 0.0, z);
        const Eigen::Vector4d clip = stage.view_projection * corner.homogeneous();
        EXPECT_LT(clip.z(), clip.w());  // nearer than the far plane
      }
  }
}

TEST(Stage, KeepsAGivenGround) {
  Settings settings;
  settings.ground_height = -3.25;
  EXPECT_EQ(make_stage(settings, boxes[0]).ground_height, -3.25);
}

TEST(CoveredPixels, SpansThePointsAndClipsToThePicture) {
  Eigen::MatrixX3f points(2, 3);
  points << -0.5f, 0.0f, 0.0f, 0.25f, 0.5f, 0.0f;
  const PixelBox box = covered_pixels(points, Eigen::Matrix4f::Identity(), 80, 40);
  EXPECT_EQ(box.left, 19);
  EXPECT_EQ(box.right, 52);
  EXPECT_EQ(box.bottom, 19);
  EXPECT_EQ(box.top, 32);
  points *= 100.0f;
  const PixelBox clipped = covered_pixels(points, Eigen::Matrix4f::Identity(), 80, 40);
  EXPECT_EQ(clipped.left, 0);
  EXPECT_EQ(clipped.right, 80);
}

TEST(CoveredPixels, IsThePictureWhenAPointIsBehindTheEyeAndNothingWithoutPoints) {
  Eigen::MatrixX3f points = Eigen::MatrixX3f::Zero(1, 3);
  Eigen::Matrix4f behind = Eigen::Matrix4f::Identity();
  behind(3, 3) = -1.0f;
  EXPECT_EQ(covered_pixels(points, behind, 80, 40).width(), 80);
  EXPECT_TRUE(covered_pixels(Eigen::MatrixX3f(0, 3), behind, 80, 40).empty());
}

}  // namespace
}  // namespace billow::render
