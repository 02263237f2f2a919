// What a look at a mesh finds, on meshes where that is known.
#include "sim/mesh/mesh_report.h"

#include <gtest/gtest.h>

#include "sim/mesh/boundary.h"
#include "sim/mesh/closed_surface.h"
#include "sim/mesh/pieces.h"
#include "sim/mesh/shapes.h"
#include "tests/support/mesh_files.h"

namespace billow::sim {
namespace {

using test::bare_mesh;
using test::quad_grid;

Mesh unit_box() { return box_mesh({0, 0, 0}, {1, 1, 1}, Eigen::Matrix3d::Identity()); }

TEST(MeshReport, CountsASheet) {
  const MeshReport report = report_of(quad_grid(4, 3));
  EXPECT_EQ(report.vertices, 12);
  EXPECT_EQ(report.quads, 6);
  EXPECT_EQ(report.edges, 17);
  EXPECT_DOUBLE_EQ(report.area, 6.0);
  ASSERT_EQ(report.borders.size(), 1u);
  EXPECT_EQ(report.borders[0].edges, 10);
  EXPECT_DOUBLE_EQ(report.borders[0].length, 10.0);
  EXPECT_EQ(report.holes(), 0);
  EXPECT_FALSE(report.closed());
  EXPECT_EQ(report.pieces.size(), 1u);
}

TEST(MeshReport, SeesASolid) {
  const MeshReport report = report_of(unit_box());
  EXPECT_TRUE(report.closed());
  EXPECT_NEAR(report.volume, 1.0, 1e-12);
  EXPECT_NEAR(report.area, 6.0, 1e-12);
}

TEST(MeshReport, FindsHoles) {
  Mesh mesh = quad_grid(5, 5);
  mesh.face.erase(mesh.face.begin() + 5);
  mesh.uv.erase(mesh.uv.begin() + 5);
  const MeshReport report = report_of(mesh);
  ASSERT_EQ(report.borders.size(), 2u);
  EXPECT_EQ(report.borders[1].edges, 4);
  EXPECT_EQ(report.holes(), 1);
  EXPECT_EQ(report_of(with_holes_closed(mesh, 4)).holes(), 0);
  EXPECT_EQ(with_holes_closed(mesh, 3).face.size(), mesh.face.size());
}

TEST(MeshReport, FindsFaults) {
  const Mesh mesh = bare_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {2, 0, 0}, {2, 1e-6, 0}},
                              {{0, 1, 2, -1}, {2, 0, 1, -1}, {0, 1, 3, -1}, {1, 0, 4, -1}, {1, 5, 6, -1}});
  const MeshReport report = report_of(mesh);
  EXPECT_EQ(report.duplicate_faces.count, 1);
  EXPECT_EQ(report.crowded_edges.count, 1);
  EXPECT_EQ(report.tiny_edges.count, 1);
  EXPECT_EQ(report.flat_faces.count, 0);
  EXPECT_EQ(report.turned_edges.count, 2);  // of the face that is there twice
  EXPECT_EQ(report_of(bare_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2, -1}})).flat_faces.count, 1);
}

TEST(MeshReport, FindsSeams) {
  Mesh mesh = quad_grid(3, 2);
  EXPECT_EQ(report_of(mesh).seams.count, 0);
  for (Eigen::Vector2f& uv : mesh.uv[1]) uv.x() += 1.0f;
  EXPECT_EQ(report_of(mesh).seams.count, 1);
}

TEST(MeshReport, GuessesUnits) {
  const auto guess = [](double size) { return likely_unit({Eigen::Vector3d::Zero(), Eigen::Vector3d(size, 1, 1)}); };
  EXPECT_EQ(guess(1.5), "");
  EXPECT_EQ(guess(20.0), "");
  EXPECT_EQ(guess(150.0), "cm");
  EXPECT_EQ(guess(1500.0), "mm");
}

TEST(Pieces, HangTogetherByFaces) {
  const Mesh mesh =
      bare_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{3, 4, 5, -1}, {0, 1, 2, -1}});
  EXPECT_EQ(pieces(mesh), (std::vector<std::vector<int>>{{0, 1, 2}, {3, 4, 5}}));
}

TEST(Boundary, ClosesABoxThatLacksSides) {
  Mesh mesh = unit_box();
  const double volume = enclosed_volume(mesh);
  // Of a box with sides in a grid, one quad in each of two sides.
  mesh.face.erase(mesh.face.begin() + static_cast<std::ptrdiff_t>(mesh.face.size()) - 1);
  mesh.face.erase(mesh.face.begin());
  if (!mesh.uv.empty()) mesh.uv.pop_back(), mesh.uv.erase(mesh.uv.begin());
  EXPECT_THROW(require_solid(mesh), std::runtime_error);
  const Mesh closed = with_holes_closed(mesh, 100);
  EXPECT_NO_THROW(require_solid(closed));
  EXPECT_NEAR(enclosed_volume(closed), volume, 1e-12);
}

}  // namespace
}  // namespace billow::sim
