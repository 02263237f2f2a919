// Which vertices a scene's words pick.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "sim/body/cloth.h"
#include "sim/mesh/selection.h"
#include "tests/support/mesh_files.h"

namespace billow::sim {
namespace {

using test::quad_grid;
using testing::ElementsAre;
using testing::HasSubstr;

std::string refusal(const Mesh& mesh, const Selector& selector) {
  try {
    select_vertices(mesh, selector);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Selection, FindsCornersOfTheTexture) {
  const Mesh grid = quad_grid(5, 4);
  EXPECT_THAT(select_vertices(grid, Corner::top_left), ElementsAre(0));
  EXPECT_THAT(select_vertices(grid, Corner::top_right), ElementsAre(4));
  EXPECT_THAT(select_vertices(grid, Corner::bottom_left), ElementsAre(15));
  EXPECT_THAT(select_vertices(grid, Corner::bottom_right), ElementsAre(19));
}

// A texture that repeats goes past 1; its corners are still the cloth's.
TEST(Selection, FindsCornersOfATextureThatRepeats) {
  Mesh grid = quad_grid(5, 4);
  for (auto& face : grid.uv)
    for (Eigen::Vector2f& uv : face) uv *= 3.0f;
  EXPECT_THAT(select_vertices(grid, Corner::top_right), ElementsAre(4));
}

TEST(Selection, FindsCornersOfAFlatMeshWithoutTexture) {
  Mesh lying = quad_grid(5, 4);
  lying.uv.clear();
  EXPECT_THAT(select_vertices(lying, Corner::top_left), ElementsAre(0)) << "up is -z on a mesh that lies flat";
  EXPECT_THAT(select_vertices(lying, Corner::bottom_right), ElementsAre(19));

  Mesh hanging = lying;  // x to the right, y up: the row z = 0 becomes the bottom
  hanging.position.col(1) = lying.position.col(2);
  hanging.position.col(2).setZero();
  EXPECT_THAT(select_vertices(hanging, Corner::bottom_left), ElementsAre(0));
  EXPECT_THAT(select_vertices(hanging, Corner::top_right), ElementsAre(19));

  Mesh sideways = hanging;  // seen from +x, -z is to the right
  sideways.position.col(2) = -hanging.position.col(0);
  sideways.position.col(0).setZero();
  EXPECT_THAT(select_vertices(sideways, Corner::bottom_left), ElementsAre(0));
}

TEST(Selection, SortsAndUnitesLists) {
  EXPECT_THAT(select_vertices(quad_grid(5, 4), VertexList{{7, 3, 7, 0}}), ElementsAre(0, 3, 7));
}

TEST(Selection, SaysHowManyVerticesThereAre) {
  EXPECT_THAT(refusal(quad_grid(5, 4), VertexList{{3, 20}}),
              HasSubstr("there is no vertex 20: the mesh has 20, numbered 0 to 19"));
  EXPECT_THAT(refusal(quad_grid(5, 4), VertexList{{-1}}), HasSubstr("there is no vertex -1"));
  EXPECT_THAT(refusal(quad_grid(5, 4), VertexList{}), HasSubstr("empty"));
}

TEST(Selection, TakesTheEdgesOfABoxIn) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(2, 0, 1));
  EXPECT_THAT(select_vertices(quad_grid(5, 4), box), ElementsAre(1, 2, 6, 7));
}

TEST(Selection, SaysWhereTheMeshIsWhenABoxMissesIt) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(9, 2, 9));
  EXPECT_EQ(refusal(quad_grid(5, 4), box),
            "the box [0, 1, 0] to [9, 2, 9] holds no vertex: the mesh lies in [0, 0, 0] to [4, 0, 3]");
}

TEST(Selection, FindsGroupsAndSuggestsThem) {
  Mesh mesh = quad_grid(5, 4);
  mesh.group = {{"hem", {15, 16}}, {"hole_rim", {6, 7}}};
  EXPECT_THAT(select_vertices(mesh, GroupName{"hem"}), ElementsAre(15, 16));
  EXPECT_EQ(refusal(mesh, GroupName{"hole_rin"}),
            "there is no group 'hole_rin' in the mesh; did you mean 'hole_rim'? it has 'hem', 'hole_rim'");
  EXPECT_EQ(refusal(mesh, GroupName{"Sleeve"}), "there is no group 'Sleeve' in the mesh; it has 'hem', 'hole_rim'");
  EXPECT_THAT(refusal(quad_grid(2, 2), GroupName{"hem"}), HasSubstr("the mesh has no named groups"));
}

}  // namespace
}  // namespace billow::sim
