// Which vertices springs join: exact counts on grids, and what must hold on any mesh.
#include "sim/body/cloth_springs.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "base/error.h"
#include "sim/import/mesh_import.h"
#include "tests/support/mesh_files.h"

namespace billow::sim {
namespace {

using test::bare_mesh;
using test::quad_grid;
using test::triangulated;

std::array<int, 3> counts(const std::vector<SpringPair>& springs) {
  std::array<int, 3> count{};
  for (const SpringPair& s : springs) ++count[static_cast<std::size_t>(s.kind)];
  return count;
}

// Sorted, in range, first < second, and no pair twice, whatever its kind.
void expect_sound(const std::vector<SpringPair>& springs, const Mesh& mesh) {
  std::set<std::pair<int, int>> pairs;
  for (const SpringPair& s : springs) {
    EXPECT_LE(0, s.first);
    EXPECT_LT(s.first, s.second);
    EXPECT_LT(s.second, mesh.vertices());
    EXPECT_TRUE(pairs.emplace(s.first, s.second).second) << s.first << "-" << s.second << " twice";
  }
  EXPECT_TRUE(std::is_sorted(springs.begin(), springs.end(), [](const SpringPair& a, const SpringPair& b) {
    return std::tie(a.kind, a.first, a.second) < std::tie(b.kind, b.first, b.second);
  }));
}

TEST(ClothSprings, AreTheTextbookOnesOnAGridOfQuads) {
  for (const auto& [w, h] : {std::pair{2, 2}, {2, 7}, {3, 3}, {5, 4}, {10, 10}, {50, 50}}) {
    SCOPED_TRACE(testing::Message() << w << " x " << h);
    const Mesh mesh = quad_grid(w, h);
    const std::vector<SpringPair> springs = cloth_springs(mesh);
    EXPECT_EQ(counts(springs),
              (std::array{w * (h - 1) + h * (w - 1), 2 * (w - 1) * (h - 1), (w - 2) * h + w * (h - 2)}));
    expect_sound(springs, mesh);
  }
}

TEST(ClothSprings, BendAlongRowsAndColumnsOfAGrid) {
  for (const SpringPair& s : cloth_springs(quad_grid(6, 5))) {
    if (s.kind != SpringKind::bend) continue;
    const int step = s.second - s.first;
    EXPECT_TRUE((step == 2 && s.first % 6 < 4) || step == 12) << s.first << "-" << s.second;
  }
}

// Every quad cut along the same diagonal. Shear: the other diagonal of each quad, and across each inner side, from
// (x, z) to (x + 2, z + 1) or its mirror image. Bend: along rows, along columns, and along the cuts.
TEST(ClothSprings, FollowTheCutsOfATriangulatedGrid) {
  for (const auto& [w, h] : {std::pair{2, 2}, {4, 3}, {9, 9}}) {
    SCOPED_TRACE(testing::Message() << w << " x " << h);
    const Mesh mesh = triangulated(quad_grid(w, h));
    const std::vector<SpringPair> springs = cloth_springs(mesh);
    const int sides = w * (h - 1) + h * (w - 1), quads = (w - 1) * (h - 1), rim = 2 * (w - 1) + 2 * (h - 1);
    EXPECT_EQ(counts(springs),
              (std::array{sides + quads, quads + sides - rim, (w - 2) * h + w * (h - 2) + (w - 2) * (h - 2)}));
    expect_sound(springs, mesh);
  }
}

// No shear across the edge between a quad and a triangle; the two long ways around it bend instead.
TEST(ClothSprings, DoNotShearBetweenAQuadAndATriangle) {
  const Mesh mesh = bare_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0.5, 0}}, {{0, 1, 2, 3}, {1, 4, 2, -1}});
  EXPECT_EQ(counts(cloth_springs(mesh)), (std::array{6, 2, 2}));
}

// Three triangles on one edge, as where a pocket is sewn on: each is joined with the next.
TEST(ClothSprings, HoldSheetsTogetherThatMeetInOneEdge) {
  const Mesh mesh = bare_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                              {{0, 1, 2, -1}, {0, 1, 3, -1}, {0, 1, 4, -1}});
  const std::vector<SpringPair> springs = cloth_springs(mesh);
  EXPECT_EQ(counts(springs)[0], 7);
  EXPECT_EQ(counts(springs)[1], 2);
  expect_sound(springs, mesh);
}

// The opposite corners of two faces of a tetrahedron are already joined by its sixth edge.
TEST(ClothSprings, NeverJoinAPairTwice) {
  const Mesh tetrahedron = bare_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                     {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}});
  EXPECT_EQ(counts(cloth_springs(tetrahedron)), (std::array{6, 0, 0}));
}

TEST(ClothSprings, AreSoundOnIrregularMeshes) {
  for (const char* name : {"cloth_irregular.obj", "tablecloth_round.obj"}) {
    SCOPED_TRACE(name);
    const Mesh mesh = import_mesh(std::string(BILLOW_SOURCE_DIR "/assets/meshes/") + name);
    const std::vector<SpringPair> springs = cloth_springs(mesh);
    expect_sound(springs, mesh);
    EXPECT_GT(counts(springs)[2], mesh.vertices()) << "nearly every vertex should be bent across";
  }
}

TEST(ClothSprings, DoNotDependOnTheOrderOfFaces) {
  Mesh mesh = import_mesh(BILLOW_SOURCE_DIR "/assets/meshes/tablecloth_round.obj");
  const auto key = [](const std::vector<SpringPair>& springs) {
    std::vector<std::tuple<SpringKind, int, int>> keys;
    for (const SpringPair& s : springs) keys.emplace_back(s.kind, s.first, s.second);
    return keys;
  };
  const auto before = key(cloth_springs(mesh));
  std::reverse(mesh.face.begin(), mesh.face.end());
  EXPECT_EQ(key(cloth_springs(mesh)), before);
}

// Pairing takes the square of a vertex's edges, so a fan of a hundred thousand would never end.
TEST(ClothSprings, RefuseAVertexWithTooManyEdges) {
  std::vector<Eigen::Vector3d> positions = {{0, 0, 0}};
  std::vector<Face> faces;
  for (int k = 0; k < 2000; ++k) {
    positions.emplace_back(std::cos(k * M_PI / 1000.0), 0, std::sin(k * M_PI / 1000.0));
    faces.push_back({0, k + 1, (k + 1) % 2000 + 1, -1});
  }
  EXPECT_THROW(cloth_springs(bare_mesh(positions, faces)), InputError);
}

}  // namespace
}  // namespace billow::sim
