// A mesh's file in its own numbering, seams, loose vertices and all.
#include "sim/mesh/file_layout.h"

#include <gtest/gtest.h>

#include "sim/import/mesh_import.h"
#include "tests/support/mesh_files.h"

namespace billow::sim {
namespace {

using test::TemporaryFolder;

// Every vertex of the file at its own place, through the mesh's.
Eigen::MatrixX3d positions_of(const Mesh& mesh) { return mesh.layout.spread(mesh.position, mesh.layout.loose); }

// Vertices 1 and 4 lie at the same place, 2 is of no face, and a pentagon becomes a fan.
constexpr const char* obj = R"(o second
v 0 0 0
v 1 0 0
v 5 5 5
v 1 1 0
v 1 0 0
v 2 0 0
v 2 1 0
v 1 2 0
vt 0 0
vt 1 0
vt 1 1
usemtl b
f 5/1 6/2 7/3 8/2 4/1
usemtl a
f 1/3 2/2 4/1
f 1 4 8
)";

TEST(FileLayout, OfAnObjFileIsItsLines) {
  const TemporaryFolder folder;
  const Mesh mesh = import_mesh(folder.write("two.obj", obj));
  EXPECT_EQ(mesh.vertices(), 6);
  Eigen::MatrixX3d expected(8, 3);
  expected << 0, 0, 0, 1, 0, 0, 5, 5, 5, 1, 1, 0, 1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 2, 0;
  EXPECT_EQ(positions_of(mesh), expected);
  EXPECT_EQ(mesh.layout.vertex[1], mesh.layout.vertex[4]);
  EXPECT_EQ(mesh.layout.vertex[2], -1);
  const std::vector<Face> faces{{4, 5, 6, -1}, {4, 6, 7, -1}, {4, 7, 3, -1}, {0, 1, 3, -1}, {0, 3, 7, -1}};
  EXPECT_EQ(mesh.layout.face, faces);
  ASSERT_EQ(mesh.layout.uv.rows(), 3);
  const std::vector<Face> corners{{0, 1, 2, -1}, {0, 2, 1, -1}, {0, 1, 0, -1}, {2, 1, 0, -1}, {-1, -1, -1, -1}};
  EXPECT_EQ(mesh.layout.uv_corner, corners);
}

TEST(FileLayout, OfOtherFilesIsTheirVertices) {
  const TemporaryFolder folder;
  Mesh seamed = test::triangulated(test::quad_grid(3, 3));
  seamed.position.conservativeResize(11, 3);
  seamed.position.row(9) = seamed.position.row(4);
  seamed.position.row(10) << 7, 7, 7;
  seamed.face.back() = {9, 8, 5, -1};
  seamed.uv.clear();
  for (const char* extension : {"ply", "off"}) {
    SCOPED_TRACE(extension);
    const Mesh mesh = import_mesh(folder.write(std::string("seam.") + extension, test::mesh_file(extension, seamed)));
    EXPECT_EQ(mesh.vertices(), 9);
    EXPECT_EQ(positions_of(mesh), seamed.position);
    EXPECT_EQ(mesh.layout.face, seamed.face);
    EXPECT_EQ(mesh.layout.vertex[9], mesh.layout.vertex[4]);
    EXPECT_EQ(mesh.layout.vertex[10], -1);
  }
}

TEST(FileLayout, MovesWithTheMesh) {
  const TemporaryFolder folder;
  const Mesh mesh = import_mesh(folder.write("two.obj", obj));
  Eigen::Matrix3d turn;
  turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const Mesh moved = transformed(mesh, 2.0 * turn, {1, 0, 0});
  EXPECT_EQ(positions_of(moved).row(2), Eigen::RowVector3d(-9, 10, 10));
}

TEST(FileLayout, OfAMeshWithoutAFileIsItsOwn) {
  const Mesh grid = test::quad_grid(3, 2);
  const FileLayout layout = file_layout(grid);
  EXPECT_EQ(layout.face, grid.face);
  EXPECT_EQ(layout.spread(grid.position, layout.loose), grid.position);
  for (std::size_t f = 0; f < grid.face.size(); ++f)
    for (int c = 0; c < 4; ++c)
      EXPECT_EQ(Eigen::Vector2f(layout.uv.row(layout.uv_corner[f][c])), grid.uv[f][c]) << f << ' ' << c;
}

}  // namespace
}  // namespace billow::sim
