// Soft bodies: which meshes make one, which springs brace it, how its material varies, and that it holds its shape.
#include "sim/body/soft_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <numbers>
#include <set>

#include "base/error.h"
#include "sim/body/interior_springs.h"
#include "sim/body/momenta.h"
#include "sim/force/forces.h"
#include "sim/force/spring_force.h"
#include "sim/limit/stiffness_scale.h"
#include "sim/linear/max_eigenvalue.h"
#include "sim/mesh/closed_surface.h"
#include "sim/step/solver.h"
#include "tests/support/mesh_files.h"

namespace billow::sim {
namespace {

using testing::HasSubstr;
using Pair = std::pair<int, int>;

// Vertex x + 2 y + 4 z of the unit cube, faces outwards.
Mesh cube() {
  std::vector<Eigen::Vector3d> corner;
  for (int v = 0; v < 8; ++v) corner.emplace_back(v & 1, (v >> 1) & 1, (v >> 2) & 1);
  return test::bare_mesh(corner, {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
}

// +x, -x, +y, -y, +z, -z.
Mesh octahedron() {
  return test::bare_mesh({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, {{0, 2, 4, -1},
                                                                                                 {2, 1, 4, -1},
                                                                                                 {1, 3, 4, -1},
                                                                                                 {3, 0, 4, -1},
                                                                                                 {2, 0, 5, -1},
                                                                                                 {1, 2, 5, -1},
                                                                                                 {3, 1, 5, -1},
                                                                                                 {0, 3, 5, -1}});
}

// A bar along x of unit cells, 2 x 2 across: length + 1 rings of four, the ends closed. Vertex 4 ring + k.
Mesh bar(int length) {
  std::vector<Eigen::Vector3d> place;
  for (int x = 0; x <= length; ++x)
    for (const auto& [y, z] : {Pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) place.emplace_back(x, y, z);
  std::vector<Face> faces{{3, 2, 1, 0}, {4 * length, 4 * length + 1, 4 * length + 2, 4 * length + 3}};
  for (int x = 0; x < length; ++x)
    for (int k = 0; k < 4; ++k)
      faces.push_back({4 * x + k, 4 * x + (k + 1) % 4, 4 * x + 4 + (k + 1) % 4, 4 * x + 4 + k});
  return test::bare_mesh(place, faces);
}

Mesh moved(const Mesh& mesh) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  return transformed(mesh, 3.7 * turn, {5, -2, 9});
}

std::string refusal(const Mesh& mesh) {
  try {
    build_soft_body(mesh, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

std::map<SpringKind, int> counts(const Structure& body) {
  std::map<SpringKind, int> count;
  for (const SpringKind kind : body.kind) ++count[kind];
  return count;
}

// ---- what is a solid ----

TEST(ClosedSurface, MeasuresWhatItEncloses) {
  EXPECT_NEAR(enclosed_volume(cube()), 1.0, 1e-12);
  EXPECT_NEAR(enclosed_volume(octahedron()), 4.0 / 3.0, 1e-12);
  EXPECT_NEAR(enclosed_volume(bar(5)), 5.0, 1e-12);
  EXPECT_NEAR(enclosed_volume(moved(cube())), std::pow(3.7, 3), 1e-9);
}

TEST(ClosedSurface, HasNormalsThatPointOutWhicheverWayItsFacesDo) {
  Mesh inside_out = octahedron();
  for (Face& face : inside_out.face) std::swap(face[0], face[1]);
  EXPECT_TRUE(outward_normals(octahedron()).isApprox(octahedron().position));
  EXPECT_TRUE(outward_normals(inside_out).isApprox(octahedron().position));
}

TEST(SoftBody, RefusesAMeshWithAHole) {
  Mesh open = cube();
  open.face.pop_back();
  EXPECT_THAT(refusal(open), HasSubstr("belongs to 1 face, and a soft body's surface must be closed"));
  EXPECT_THAT(refusal(test::quad_grid(3, 3)), HasSubstr("close the mesh, say 'close_holes: true', or make it a cloth"));
}

TEST(SoftBody, RefusesAnEdgeOfThreeFaces) {
  Mesh winged = cube();
  winged.face.push_back({0, 1, 7, -1});
  EXPECT_THAT(refusal(winged), HasSubstr("belongs to 3 faces"));
}

TEST(SoftBody, RefusesFacesThatFaceOppositeWays) {
  Mesh mixed = cube();
  std::swap(mixed.face[2][0], mixed.face[2][2]);
  EXPECT_THAT(refusal(mixed), HasSubstr("face opposite ways"));
}

TEST(SoftBody, RefusesAFlatMeshThatIsClosed) {
  const Mesh flat = test::bare_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2, -1}, {0, 2, 1, -1}});
  EXPECT_THAT(refusal(flat), HasSubstr("encloses no volume"));
}

TEST(SoftBody, RefusesSeveralPieces) {
  Mesh two = cube();
  const Mesh other = transformed(cube(), Eigen::Matrix3d::Identity(), {3, 0, 0});
  two.position.conservativeResize(16, 3);
  two.position.bottomRows(8) = other.position;
  for (Face face : other.face) two.face.push_back({face[0] + 8, face[1] + 8, face[2] + 8, face[3] + 8});
  EXPECT_THAT(refusal(two), HasSubstr("2 separate surfaces that would fall apart"));
}

// ---- springs ----

// Edges, both diagonals of each face, and the four diagonals through the middle: every pair of the eight corners once.
TEST(SoftBody, BracesACubeByItsFourDiagonals) {
  const Structure body = build_soft_body(cube(), {});
  EXPECT_EQ(counts(body), (std::map<SpringKind, int>{
                              {SpringKind::structural, 12}, {SpringKind::shear, 12}, {SpringKind::interior, 4}}));
  std::set<Pair> interior;
  for (int s = 24; s < 28; ++s) interior.emplace(body.spring(s, 0), body.spring(s, 1));
  EXPECT_EQ(interior, (std::set<Pair>{{0, 7}, {1, 6}, {2, 5}, {3, 4}}));
  EXPECT_TRUE(body.rest_length.tail(4).isApproxToConstant(std::sqrt(3.0)));
}

// The axes of an octahedron also lie across its edges, where the cloth of its surface already has shear springs.
TEST(SoftBody, JoinsNoPairTwice) {
  const auto pairs = interior_pairs(octahedron());
  for (const Pair& axis : {Pair{0, 1}, {2, 3}, {4, 5}})
    EXPECT_TRUE(std::binary_search(pairs.begin(), pairs.end(), axis));
  EXPECT_EQ(counts(build_soft_body(octahedron(), {})),
            (std::map<SpringKind, int>{{SpringKind::structural, 12}, {SpringKind::shear, 3}}));
}

// Every vertex of a long bar is held by others across it, on both sides along it, and no pair is joined twice.
TEST(SoftBody, BracesABarAcrossAndAlong) {
  const Mesh mesh = bar(9);
  const auto pairs = interior_pairs(mesh);
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  EXPECT_EQ(std::set<Pair>(pairs.begin(), pairs.end()).size(), pairs.size());
  for (int v = 8; v < 32; ++v) {
    std::set<int> ways;  // the signs of the other ends' positions along the bar
    for (const auto& [i, j] : pairs) {
      if (i != v && j != v) continue;
      const Eigen::RowVector3d across = mesh.position.row(i == v ? j : i) - mesh.position.row(v);
      if (across.tail<2>().norm() > 0.5) ways.insert((across.x() > 0.5) - (across.x() < -0.5));
    }
    EXPECT_EQ(ways.size(), 3u) << "vertex " << v;
  }
}

TEST(SoftBody, IsBracedAlikeWhereverItLies) {
  for (const Mesh& mesh : {cube(), octahedron(), bar(4)}) EXPECT_EQ(interior_pairs(mesh), interior_pairs(moved(mesh)));
}

// ---- material ----

SoftBodyOptions varied_bar() {
  SoftBodyOptions options;
  options.stiffness_factor = Eigen::VectorXd::LinSpaced(16, 1.0, 2.5);
  options.mass_factor = Eigen::VectorXd::LinSpaced(16, 3.0, 1.5);
  return options;
}

TEST(SoftBody, VariesItsStiffnessByTheMeanOfASpringsEnds) {
  const Structure even = build_soft_body(bar(3), {}), varied = build_soft_body(bar(3), varied_bar());
  ASSERT_EQ(even.springs(), varied.springs());
  for (int s = 0; s < even.springs(); ++s)
    EXPECT_DOUBLE_EQ(varied.stiffness(s) / even.stiffness(s), 1.0 + 0.05 * (even.spring(s, 0) + even.spring(s, 1)));
}

TEST(SoftBody, VariesItsDensityAndKeepsItsWeight) {
  SoftBodyOptions options = varied_bar();
  options.surface.pinned = {2};
  const Structure even = build_soft_body(bar(3), {}), varied = build_soft_body(bar(3), options);
  EXPECT_NEAR(varied.mass.sum(), 1.0, 1e-12);
  const Eigen::ArrayXd ratio = varied.mass.array() / even.mass.array() / options.mass_factor.array();
  EXPECT_NEAR(ratio.minCoeff(), ratio.maxCoeff(), 1e-12);
  for (int i = 0; i < 16; ++i) EXPECT_DOUBLE_EQ(varied.inverse_mass(i), i == 2 ? 0.0 : 1.0 / varied.mass(i));
}

TEST(ScaleStiffness, ReachesTheWantedEigenvalueOfASoftBody) {
  Structure body = build_soft_body(bar(3), varied_bar());
  scale_stiffness(body, 5000.0);
  EXPECT_NEAR(max_eigenvalue(body, linearise_at_rest(body).stiffness).value, 5000.0, 5.0);
}

// ---- motion ----

// A free bar thrown and spinning keeps its momentum; its springs bring it back to its volume after a squeeze.
TEST(SoftBody, SpringsBackFromASqueeze) {
  SoftBodyOptions options;
  options.surface.damping = 0.5;
  const Mesh mesh = bar(6);
  const Structure body = build_soft_body(mesh, options);
  const Forces forces(body, Eigen::Vector3d::Zero());
  State squeezed = rest_state(body);
  squeezed.position.col(1) *= 0.7;
  squeezed.velocity.col(0).setConstant(0.3);
  Solver solver(body, forces, {.step = 0.001}, squeezed);
  const State late = solver.sample(4.0);
  EXPECT_NEAR((linear_momentum(body, late) - Eigen::Vector3d(0.3, 0, 0)).norm(), 0.0, 1e-9);
  Mesh after = mesh;
  after.position = late.position;
  EXPECT_NEAR(enclosed_volume(after), 6.0, 0.01);
}

}  // namespace
}  // namespace billow::sim
