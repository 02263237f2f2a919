// K x over runs of springs: against the blocks written out, and the same bits on every instruction set.
#include "sim/linear/stiffness_product.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <set>

#include "base/random.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::grid;
using test::ring;

// Long runs with near and far ends, one of more than a piece, and a ring that has springs to no run.
Structure sheet_and_ring() { return merge({grid({.width = 37, .height = 19}), ring(6, 1.0, 1.0)}); }

/// Random blocks B = a I + b u u^T, by slot; zero where there is no spring.
struct Blocks {
  Blocks(const Structure& structure, const ProductPlan& plan)
      : direction(Eigen::MatrixX3d::Zero(plan.slots(), 3)), factors(Eigen::MatrixX3d::Zero(plan.slots(), 3)) {
    const Eigen::MatrixX3d noise = seeded_noise(structure.springs(), 3), other = seeded_noise(structure.springs(), 4);
    for (int s = 0; s < structure.springs(); ++s) {
      direction.row(plan.slot[s]) = noise.row(s).normalized();
      factors.row(plan.slot[s]) = other.row(s);
    }
  }
  BlockColumns columns() const {
    return {direction.col(0).data(), direction.col(1).data(), direction.col(2).data(), factors.col(0).data(),
            factors.col(1).data()};
  }
  Eigen::Matrix3d at(int slot) const {
    const Eigen::Vector3d u = direction.row(slot);
    return factors(slot, 0) * Eigen::Matrix3d::Identity() + factors(slot, 1) * u * u.transpose();
  }
  Eigen::MatrixX3d direction, factors;
};

TEST(ProductPlan, GivesEverySpringASlotBetweenItsOwnParticles) {
  const Structure structure = sheet_and_ring();
  const ProductPlan plan(structure);
  EXPECT_EQ(std::set<int>(plan.slot.begin(), plan.slot.end()).size(), static_cast<std::size_t>(structure.springs()));
  for (int s = 0; s < structure.springs(); ++s) {
    EXPECT_EQ(plan.first[plan.slot[s]], structure.spring(s, 0));
    EXPECT_EQ(plan.second[plan.slot[s]], structure.spring(s, 1));
  }
  int next = 0, loose = 0;
  for (const ProductPlan::Piece& piece : plan.pieces) {
    EXPECT_EQ(piece.begin, next);
    next += piece.count;
    loose += piece.loose ? piece.count : 0;
    for (int k = 0; k < piece.count && !piece.loose; ++k) {
      ASSERT_EQ(plan.first[piece.begin + k], piece.first + k);
      ASSERT_EQ(plan.second[piece.begin + k], piece.second + k);
      ASSERT_LT(piece.second + k, structure.particles());
    }
  }
  EXPECT_EQ(next, plan.slots());
  EXPECT_GT(loose, 0);
  EXPECT_LT(loose, 20);
  EXPECT_LT(plan.slots(), 1.1 * structure.springs());
}

TEST(StiffnessProduct, IsTheSumOfTheBlocksOnEveryInstructionSetBitForBit) {
  const Structure structure = sheet_and_ring();
  const ProductPlan plan(structure);
  const Blocks blocks(structure, plan);
  const Eigen::MatrixX3d x = seeded_noise(structure.particles(), 5);
  Eigen::MatrixX3d expected = Eigen::MatrixX3d::Ones(x.rows(), 3), first_result;
  for (int k = 0; k < plan.slots(); ++k) {
    const Eigen::RowVector3d force = (x.row(plan.first[k]) - x.row(plan.second[k])) * blocks.at(k);
    expected.row(plan.first[k]) += force;
    expected.row(plan.second[k]) -= force;
  }
  test::on_every_instruction_set([&] {
    Eigen::MatrixX3d out = Eigen::MatrixX3d::Ones(x.rows(), 3);
    add_product(plan, blocks.columns(), x, out);
    EXPECT_LT((out - expected).norm(), 1e-13 * expected.norm());
    if (first_result.size() == 0) first_result = out;
    EXPECT_EQ(out, first_result);
  });
}

TEST(StiffnessProduct, SumsTheDiagonalBlocksOnEveryInstructionSetBitForBit) {
  const Structure structure = sheet_and_ring();
  const ProductPlan plan(structure);
  const Blocks blocks(structure, plan);
  Eigen::MatrixX3d first_straight, first_mixed;
  test::on_every_instruction_set([&] {
    Eigen::MatrixX3d straight = Eigen::MatrixX3d::Zero(structure.particles(), 3), mixed = straight;
    add_diagonal_blocks(plan, blocks.columns(), straight, mixed);
    if (first_straight.size() == 0) first_straight = straight, first_mixed = mixed;
    EXPECT_EQ(straight, first_straight);
    EXPECT_EQ(mixed, first_mixed);
  });
  for (int k = 0; k < plan.slots(); ++k)
    for (const int i : {plan.first[k], plan.second[k]}) {
      const Eigen::Matrix3d b = blocks.at(k);
      first_straight.row(i) -= b.diagonal();
      first_mixed.row(i) -= Eigen::RowVector3d(b(0, 1), b(0, 2), b(1, 2));
    }
  EXPECT_LT(first_straight.norm() + first_mixed.norm(), 1e-11);
}

}  // namespace
}  // namespace billow::sim
