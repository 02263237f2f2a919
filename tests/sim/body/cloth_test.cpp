// Cloth from a mesh: masses, lengths, material, pins.
#include "sim/body/cloth.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "sim/import/mesh_import.h"
#include "tests/support/mesh_files.h"

namespace billow::sim {
namespace {

using test::bare_mesh;
using test::quad_grid;
using test::triangulated;

// Unit quads, four corners each: a corner of the grid carries a quarter, a border vertex a half.
TEST(ClothMass, IsAQuarterOfEachQuadAround) {
  const Structure cloth = build_cloth(quad_grid(4, 3), {.mass = 6.0});
  EXPECT_NEAR(cloth.mass(0), 0.25, 1e-14);
  EXPECT_NEAR(cloth.mass(1), 0.5, 1e-14);
  EXPECT_NEAR(cloth.mass(5), 1.0, 1e-14);
}

TEST(ClothMass, IsAThirdOfEachTriangleAround) {
  const Structure cloth = build_cloth(triangulated(quad_grid(2, 2)), {.mass = 1.0});
  EXPECT_NEAR(cloth.mass(0), 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(cloth.mass(1), 1.0 / 6.0, 1e-15);
}

TEST(ClothMass, AddsUpToTheClothsMass) {
  for (const char* name : {"cloth_50.obj", "cloth_irregular.obj", "tablecloth_round.obj"})
    for (const bool by_area : {true, false}) {
      const Mesh mesh = import_mesh(std::string(BILLOW_SOURCE_DIR "/assets/meshes/") + name);
      const Structure cloth = build_cloth(mesh, {.mass = 0.35, .mass_by_area = by_area});
      EXPECT_NEAR(cloth.mass.sum(), 0.35, 1e-13);
      EXPECT_GT(cloth.mass.minCoeff(), 0.0);
    }
}

TEST(ClothMass, IsTheSameEverywhereWhenNotByArea) {
  const Structure cloth = build_cloth(quad_grid(4, 3), {.mass = 6.0, .mass_by_area = false});
  EXPECT_TRUE(cloth.mass.isApproxToConstant(0.5, 1e-15));
}

TEST(Cloth, TakesLengthsAndMaterialFromMeshAndOptions) {
  Mesh mesh = quad_grid(5, 4);
  mesh.position *= 0.1;
  const Structure cloth = build_cloth(mesh, {.structural = 3.0, .shear = 2.0, .bend = 1.0, .damping = 0.5});
  for (int s = 0; s < cloth.springs(); ++s) {
    const Eigen::RowVector3d d =
        cloth.rest_position.row(cloth.spring(s, 1)) - cloth.rest_position.row(cloth.spring(s, 0));
    EXPECT_DOUBLE_EQ(cloth.rest_length(s), d.norm());
    EXPECT_EQ(cloth.stiffness(s), 3.0 - static_cast<int>(cloth.kind[s]));
    EXPECT_EQ(cloth.damping(s), 0.5);
  }
}

TEST(Cloth, IsOneBodyThatKnowsItsMeanSpacing) {
  Mesh mesh = quad_grid(5, 4);
  mesh.position *= 0.1;
  const Structure cloth = build_cloth(mesh, {.name = "sail", .friction = 0.01, .pinned = {0, 4}});
  ASSERT_EQ(cloth.body.size(), 1u);
  EXPECT_EQ(cloth.body[0].name, "sail");
  EXPECT_EQ(cloth.body[0].particles, 20);
  EXPECT_EQ(cloth.body[0].springs, cloth.springs());
  EXPECT_EQ(cloth.body[0].friction, 0.01);
  EXPECT_NEAR(cloth.body[0].mean_rest_length, 0.1, 1e-15);
}

TEST(Cloth, PinnedParticlesKeepTheirMassButCannotMove) {
  const Structure cloth = build_cloth(quad_grid(5, 4), {.pinned = {0, 4}});
  for (int p = 0; p < cloth.particles(); ++p) {
    EXPECT_EQ(cloth.pinned(p), p == 0 || p == 4);
    EXPECT_GT(cloth.mass(p), 0.0);
  }
  EXPECT_THROW(build_cloth(quad_grid(5, 4), {.pinned = {20}}), InputError);
}

TEST(Cloth, RefusesJoinedVerticesAtOnePlace) {
  Mesh mesh = quad_grid(3, 3);
  mesh.position.row(4) = mesh.position.row(1);
  EXPECT_THROW(build_cloth(mesh, {.mass_by_area = false}), InputError);
}

TEST(Cloth, RefusesAVertexWithoutAreaUnlessMassIsSpreadEvenly) {
  const Mesh sliver =
      bare_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {3, 0, 0}}, {{0, 1, 2, -1}, {1, 3, 4, -1}});
  EXPECT_THROW(build_cloth(sliver, {}), InputError);
  EXPECT_EQ(build_cloth(sliver, {.mass_by_area = false}).particles(), 5);
}

TEST(Cloth, IsTheSameEveryTime) {
  const Mesh mesh = import_mesh(BILLOW_SOURCE_DIR "/assets/meshes/cloth_irregular.obj");
  const Structure a = build_cloth(mesh, {}), b = build_cloth(mesh, {});
  EXPECT_EQ(a.spring, b.spring);
  EXPECT_EQ(a.rest_length, b.rest_length);
  EXPECT_EQ(a.mass, b.mass);
}

}  // namespace
}  // namespace billow::sim
