// The drawn triangles of a mesh.
#include "sim/drawn/surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>

#include "sim/body/cloth.h"
#include "sim/import/mesh_import.h"
#include "tests/support/mesh_files.h"

namespace billow::sim {
namespace {

using test::bare_mesh;
using test::quad_grid;

Eigen::Vector3d normal(const Mesh& mesh, const Surface& surface, Eigen::Index t) {
  const auto corner = [&](int k) -> Eigen::Vector3d {
    return mesh.position.row(surface.point(surface.triangle(t, k)));
  };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0));
}

TEST(Surface, HasOneCornerPerVertexWhereTheTextureHasNoSeam) {
  const Surface surface = build_surface(quad_grid(5, 4));
  EXPECT_EQ(surface.triangle.rows(), 2 * 4 * 3);
  EXPECT_EQ(surface.point.size(), 20);
  EXPECT_EQ(surface.points(), 20);
}

// A grid looks even only if all its quads are split the same way, whichever corner their faces start at.
TEST(Surface, SplitsAllSquaresOfAGridAlike) {
  Mesh grid = quad_grid(5, 4);
  for (std::size_t f = 0; f < grid.face.size(); ++f) {
    std::rotate(grid.face[f].begin(), grid.face[f].begin() + f % 4, grid.face[f].end());
    std::rotate(grid.uv[f].begin(), grid.uv[f].begin() + f % 4, grid.uv[f].end());
  }
  const Surface surface = build_surface(grid);
  std::set<int> steps;
  for (Eigen::Index t = 0; t < surface.triangle.rows(); t += 2)
    steps.insert(std::abs(surface.point(surface.triangle(t, 2)) - surface.point(surface.triangle(t, 0))));
  EXPECT_EQ(steps, std::set<int>{6});
}

TEST(Surface, SplitsAQuadAlongItsShorterDiagonal) {
  for (const double lean : {-0.4, 0.4}) {
    SCOPED_TRACE(lean);
    const Mesh quad = bare_mesh({{0, 0, 0}, {1, 0, 0}, {1 + lean, 1, 0}, {lean, 1, 0}}, {{0, 1, 2, 3}});
    const Surface surface = build_surface(quad);
    const std::set<int> shared = {surface.point(surface.triangle(0, 0)), surface.point(surface.triangle(0, 2))};
    EXPECT_EQ(shared, lean < 0.0 ? (std::set{0, 2}) : (std::set{1, 3}));
  }
}

TEST(Surface, KeepsTheMeshsFrontInFront) {
  for (const char* name : {"cloth_50.obj", "cloth_irregular.obj", "tablecloth_round.obj"}) {
    SCOPED_TRACE(name);
    const Mesh mesh = import_mesh(std::string(BILLOW_SOURCE_DIR "/assets/meshes/") + name);
    const Surface surface = build_surface(mesh);
    for (Eigen::Index t = 0; t < surface.triangle.rows(); ++t) ASSERT_GT(normal(mesh, surface, t).y(), 0.0);
  }
}

TEST(Surface, SplitsCornersButNotPointsAtASeam) {
  Mesh mesh = quad_grid(3, 2);
  mesh.uv[1][0].x() = mesh.uv[1][1].x() = 0.9f;  // the second quad's texture does not go on from the first's
  const Surface surface = build_surface(mesh);
  EXPECT_EQ(surface.points(), 6);
  EXPECT_EQ(surface.point.size(), 8);
}

TEST(Surface, MakesFlatTextureCoordinatesWhereThereAreNone) {
  Mesh bare = quad_grid(5, 4);
  bare.uv.clear();
  const Surface surface = build_surface(bare), given = build_surface(quad_grid(5, 4));
  EXPECT_TRUE(surface.uv.isApprox(given.uv, 1e-6f));
}

}  // namespace
}  // namespace billow::sim
