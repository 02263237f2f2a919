#include "render/frame/normals.h"

#include <gtest/gtest.h>

#include "tests/support/drawn_sheet.h"

namespace billow::render {
namespace {

// Four corners over two triangles that share an edge; the seam's points have a corner on each side.
sim::Surface roof_with_a_seam() {
  sim::Surface surface;
  surface.point.resize(6);
  surface.point << 0, 1, 2, 1, 0, 3;  // corners 0, 1 and 4, 3 are the ridge's two points, once per side
  surface.uv.setZero(6, 2);
  surface.triangle.resize(2, 3);
  surface.triangle << 0, 1, 2, 3, 4, 5;
  return surface;
}

TEST(PointNormals, AreContinuousAcrossATextureSeam) {
  Eigen::MatrixX3f position(4, 3);
  position << 0, 1, 0, 0, 1, 1, 1, 0, 0.5f, -1, 0, 0.5f;  // a ridge along z, slopes to both sides
  const Eigen::MatrixX3f normal = point_normals(roof_with_a_seam(), position);
  ASSERT_EQ(normal.rows(), 4);
  EXPECT_NEAR(std::abs(normal(0, 1)), 1.0f, 1e-6f);  // on the ridge: straight up or down, both slopes at once
  EXPECT_NEAR(normal(0, 0), 0.0f, 1e-6f);
  EXPECT_GT(std::abs(normal(2, 0)), 0.5f);  // on the slope: the slope's own
}

TEST(PointNormals, DoNotDependOnHowAFlatPolygonWasSplit) {
  // A fan of unequal triangles around the corner of a cube: each face counts by its right angle.
  sim::Surface cube;
  cube.point = Eigen::VectorXi::LinSpaced(8, 0, 7);
  cube.uv.setZero(8, 2);
  cube.triangle.resize(4, 3);
  cube.triangle << 0, 1, 4, 0, 4, 2, 0, 2, 3, 0, 3, 1;  // the face between x and y has two triangles
  Eigen::MatrixX3f position = Eigen::MatrixX3f::Zero(8, 3);
  position.row(1) << 1, 0, 0;
  position.row(2) << 0, 1, 0;
  position.row(3) << 0, 0, 1;
  position.row(4) << 0.9f, 0.3f, 0;
  const Eigen::Vector3f normal = point_normals(cube, position).row(0).transpose();
  EXPECT_TRUE(normal.isApprox(Eigen::Vector3f::Constant(std::sqrt(1.0f / 3.0f)), 1e-5f)) << normal.transpose();
}

TEST(PointNormals, LeaveOutTrianglesWithoutArea) {
  test::DrawnSheet sheet = test::flat_sheet();
  sheet.state.position.row(0) = sheet.state.position.row(1);
  const Eigen::MatrixX3f normal = point_normals(sheet.body.surface, sheet.state.position);
  EXPECT_TRUE(normal.allFinite());
  EXPECT_TRUE(normal.row(4).isApprox(Eigen::RowVector3f(0, 0, 1), 1e-6f));
}

}  // namespace
}  // namespace billow::render
