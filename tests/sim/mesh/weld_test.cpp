// Welding: what is one vertex, what is dropped, what is kept.
#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"
#include "sim/body/cloth_springs.h"
#include "tests/support/mesh_files.h"

namespace billow::sim {
namespace {

using test::bare_mesh;
using test::quad_grid;
using test::soup_of;

TEST(Weld, JoinsTheCopiesOfEveryCorner) {
  const Mesh grid = quad_grid(7, 5);
  const Mesh welded = weld(soup_of(grid));
  EXPECT_EQ(welded.vertices(), 35);
  EXPECT_EQ(welded.face.size(), grid.face.size());
  EXPECT_EQ(welded.uv, grid.uv);
}

// A cylinder whose texture ends where it begins: 12 positions around, 13 texture columns.
TEST(Weld, KeepsAClothInOnePieceAcrossItsTextureSeam) {
  Mesh tube = quad_grid(13, 4);
  for (int v = 0; v < tube.vertices(); ++v) {
    const double angle = 2.0 * M_PI * (v % 13) / 12.0;
    tube.position.row(v) << std::cos(angle), v / 13, std::sin(angle);
  }
  const Mesh welded = weld(soup_of(tube));
  EXPECT_EQ(welded.vertices(), 12 * 4);
  const std::vector<SpringPair> springs = cloth_springs(welded);
  const auto structural = std::count_if(springs.begin(), springs.end(),
                                        [](const SpringPair& s) { return s.kind == SpringKind::structural; });
  EXPECT_EQ(structural, 12 * 4 + 12 * 3);
  EXPECT_EQ(welded.uv[11][2].x(), 1.0f) << "the seam's far side keeps its own texture coordinate";
  EXPECT_EQ(welded.uv[0][0].x(), 0.0f);
}

// Two copies a tenth of the tolerance apart must join wherever they lie, also on the two sides of any rounding border.
TEST(Weld, JoinsCopiesAcrossAnyRoundingBorder) {
  for (int k = 0; k < 200; ++k) {
    SCOPED_TRACE(k);
    const double shift = 1e-8 * k;
    PolygonSoup soup;
    soup.position.resize(6, 3);
    soup.position << 0, 0, 0, 1, 0, 0, 0.5 + shift, 0.5, 0,  //
        1, 0, 0, 1, 1, 0, 0.5 + shift + 1e-7, 0.5, 0;
    soup.face = {{0, 1, 2, -1}, {3, 4, 5, -1}};
    EXPECT_EQ(weld(soup).vertices(), 4);
  }
}

TEST(Weld, KeepsPointsApartThatAreFartherThanTheTolerance) {
  PolygonSoup soup;
  soup.position.resize(4, 3);
  soup.position << 0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1 + 4e-6, 0;
  soup.face = {{0, 1, 2, -1}, {0, 1, 3, -1}};
  EXPECT_EQ(weld(soup).vertices(), 4);
}

TEST(Weld, NumbersVerticesByTheirFirstCopyAndDropsUnusedOnes) {
  PolygonSoup soup;
  soup.position.resize(5, 3);
  soup.position << 9, 9, 9, 0, 0, 0, 1, 0, 0, 1, 1, 0, 7, 7, 7;
  soup.face = {{3, 1, 2, -1}};
  soup.group = {{"used", {0, 2, 3}}, {"unused", {0, 4}}};
  const Mesh mesh = weld(soup);
  EXPECT_EQ(mesh.face.front(), (Face{2, 0, 1, -1}));
  EXPECT_EQ(mesh.position.row(0), Eigen::RowVector3d(0, 0, 0));
  ASSERT_EQ(mesh.group.size(), 1u) << "a group without vertices is no group";
  EXPECT_EQ(mesh.group.at("used"), (std::vector<int>{1, 2}));
}

TEST(Weld, DropsCollapsedFacesAndMakesTrianglesOfHalfCollapsedQuads) {
  PolygonSoup soup;
  soup.position.resize(5, 3);
  soup.position << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 1, 0;  // 4 is a copy of 2
  soup.uv.resize(5, 2);
  soup.uv << 0, 0, 1, 0, 1, 1, 0, 1, 0.5f, 0.5f;
  soup.face = {{0, 1, 2, 4}, {2, 4, 3, -1}, {2, 1, 4, 0}};
  const Mesh mesh = weld(soup);
  ASSERT_EQ(mesh.face.size(), 1u);
  EXPECT_EQ(mesh.face.front(), (Face{0, 1, 2, -1}));
  EXPECT_EQ(mesh.uv.front()[2], Eigen::Vector2f(1, 1));
}

TEST(Weld, NamesTheVertexThatIsNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    PolygonSoup soup = soup_of(quad_grid(2, 2));
    soup.position(2, 1) = bad;
    try {
      weld(soup);
      FAIL();
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("vertex 2 "));
    }
  }
}

TEST(Weld, RefusesAMeshWithoutFaces) {
  EXPECT_THROW(weld(PolygonSoup{}), InputError);
  PolygonSoup point = soup_of(quad_grid(2, 2));
  point.position.setZero();
  EXPECT_THROW(weld(point), InputError);
}

TEST(Mesh, IsTransformedByScaleThenRotationThenTranslation) {
  const Mesh mesh = bare_mesh({{1, 2, 3}}, {});
  Eigen::Matrix3d quarter_about_z;
  quarter_about_z << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const Mesh moved = transformed(mesh, 2.0 * quarter_about_z, {10, 20, 30});
  EXPECT_TRUE(moved.position.row(0).isApprox(Eigen::RowVector3d(10 - 4, 20 + 2, 30 + 6)));
}

TEST(Mesh, MeasuresEveryEdgeOnce) {
  EXPECT_DOUBLE_EQ(mean_edge_length(quad_grid(4, 3)), 1.0);
  // A unit square cut in two: four sides and one diagonal.
  EXPECT_DOUBLE_EQ(mean_edge_length(test::triangulated(quad_grid(2, 2))), (4.0 + std::sqrt(2.0)) / 5.0);
}

}  // namespace
}  // namespace billow::sim
