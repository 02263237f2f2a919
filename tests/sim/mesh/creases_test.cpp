// Creases: vertices are doubled where faces turn sharply, and nowhere else.
#include "sim/mesh/creases.h"

#include <gtest/gtest.h>

#include <numbers>

#include "sim/mesh/shapes.h"
#include "tests/support/mesh_files.h"

namespace billow::sim {
namespace {

constexpr double angle = 40.0 * std::numbers::pi / 180.0;

TEST(Creases, GiveEverySideOfABoxItsOwnVertices) {
  const Mesh box = box_mesh(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(), Eigen::Matrix3d::Identity());
  const Mesh split = split_at_creases(box, angle);
  EXPECT_EQ(split.vertices(), 6 * 17 * 17);
  EXPECT_EQ(split.uv.size(), box.uv.size());
  for (std::size_t f = 0; f < box.face.size(); ++f)
    for (int c = 0; c < 4; ++c) ASSERT_EQ(split.position.row(split.face[f][c]), box.position.row(box.face[f][c]));
}

TEST(Creases, LeaveWhatIsSmoothAsItIs) {
  for (const Mesh& mesh : {sphere_mesh(Eigen::Vector3d::Zero(), 1.0), test::quad_grid(4, 3)})
    EXPECT_EQ(split_at_creases(mesh, angle).vertices(), mesh.vertices());
}

// A fold that runs from border to border comes apart; one that is smoother than the limit does not.
TEST(Creases, SplitAFoldAlongItsLength) {
  Mesh fold = test::quad_grid(3, 4);
  for (int v = 0; v < fold.vertices(); ++v)
    if (v % 3 == 2) fold.position.row(v) << 1.0, 1.0, fold.position(v, 2);
  EXPECT_EQ(split_at_creases(fold, angle).vertices(), 12 + 4);
  EXPECT_EQ(split_at_creases(fold, 100.0 * std::numbers::pi / 180.0).vertices(), 12);
}

}  // namespace
}  // namespace billow::sim
