// What few nodes see of a matrix, against the product written out.
#include "sim/linear/coarse_matrix.h"

#include <gtest/gtest.h>

#include "sim/force/forces.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

// Every axis of it alike, from all particles.
Eigen::MatrixXd dense(const SparseRows& rows, const Structure& structure, const Body& body, int nodes) {
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(3 * structure.particles(), 3 * nodes);
  for (int r = 0; r < rows.rows(); ++r)
    for (int e = rows.first[r]; e < rows.first[r + 1]; ++e)
      p.block<3, 3>(3 * (body.first_particle + r), 3 * rows.column[e]).diagonal().array() += rows.weight[e];
  return p;
}

// The body's springs but those along rows and columns are called something else, so that it is no grid any more.
Structure no_grid(Structure structure) {
  for (SpringKind& kind : structure.kind) kind = kind == SpringKind::shear ? SpringKind::structural : kind;
  return structure;
}

Structure two_sheets() {
  Structure both = merge({test::light_cloth(9, 12, {0, 8}), no_grid(test::light_cloth(11, 8, {3}))});
  both.damping.setConstant(0.02);
  return both;
}

StiffnessMatrix matrix_at(const Structure& structure) {
  const Forces forces(structure, {0.0, -9.81, 0.0});
  StiffnessMatrix matrix = forces.linearise(test::shaken_state(structure, 0.02, 1.0), 1.0, 0.1, JacobianForm::definite);
  for (int i = 0; i < structure.particles(); ++i) matrix.add_diagonal(i, structure.mass(i));
  return matrix;
}

void expect_product(const Structure& structure, const StiffnessMatrix& matrix) {
  for (const Body& body : structure.body) {
    const std::optional<NodeLevel> level = build_coarse_level(structure, body, 12);
    ASSERT_TRUE(level);
    EXPECT_EQ(level->grid.has_value(), body.first_particle == 0);
    const Eigen::MatrixXd p = dense(level->interpolation, structure, body, level->nodes());
    const Eigen::MatrixXd expected = p.transpose() * Eigen::MatrixXd(matrix.assemble(false)) * p;
    CoarseMatrix coarse(structure, body, *level);
    for (int again = 0; again < 2; ++again) {
      const Eigen::MatrixXd sum = coarse.sum(matrix).selfadjointView<Eigen::Lower>();
      EXPECT_LT((sum - expected).norm(), 1e-12 * expected.norm());
    }
  }
}

TEST(CoarseMatrix, IsWhatInterpolationMakesOfTheMatrix) {
  const Structure structure = two_sheets();
  expect_product(structure, matrix_at(structure));
}

TEST(CoarseMatrix, TakesBlocksBetweenParticlesOfItsBodyAlone) {
  const Structure structure = two_sheets();
  StiffnessMatrix matrix = matrix_at(structure);
  const Eigen::Matrix3d block = Eigen::Vector3d(1.0, 2.0, 3.0).asDiagonal();
  for (const auto& [i, j] : {std::pair(5, 40), {0, 30}, {120, 121}, {10, 150}}) matrix.add_pair(i, j, 30.0 * block);
  expect_product(structure, matrix);
}

TEST(CoarseMatrix, IsTheIdentityAtNodesThatNoParticleFollows) {
  const Structure structure = test::light_cloth(2, 9, {0, 2, 4, 6, 8, 10, 12, 14, 16});  // all of a column
  const std::optional<NodeLevel> level = build_coarse_level(structure, structure.body[0], 10);
  ASSERT_TRUE(level);
  CoarseMatrix coarse(structure, structure.body[0], *level);
  const Eigen::MatrixXd sum = coarse.sum(matrix_at(structure)).selfadjointView<Eigen::Lower>();
  EXPECT_EQ((sum.topLeftCorner<3, 3>()), Eigen::Matrix3d::Identity());
  EXPECT_GT(sum(3, 3), 0.0);
}

TEST(CoarseLevel, HasFewNodesAndEveryFreeParticleFollowsUpToFourOfThem) {
  const Structure structure = two_sheets();
  for (const Body& body : structure.body)
    for (const int most_nodes : {1, 4, 12, 40}) {
      const std::optional<NodeLevel> level = build_coarse_level(structure, body, most_nodes);
      ASSERT_TRUE(level);
      EXPECT_LE(level->nodes(), most_nodes);
      const SparseRows& rows = level->interpolation;
      ASSERT_EQ(rows.rows(), body.particles);
      for (int r = 0; r < rows.rows(); ++r) {
        const int count = rows.first[r + 1] - rows.first[r];
        double sum = 0.0;
        for (int e = rows.first[r]; e < rows.first[r + 1]; ++e) sum += rows.weight[e];
        EXPECT_LE(count, 4);
        EXPECT_NEAR(sum, structure.pinned(body.first_particle + r) ? 0.0 : 1.0, 1e-14);
      }
    }
}

TEST(CoarseLevel, IsNothingWithoutNodes) {
  EXPECT_FALSE(build_coarse_level(test::light_cloth(3, 3), test::light_cloth(3, 3).body[0], 0));
}

}  // namespace
}  // namespace billow::sim
