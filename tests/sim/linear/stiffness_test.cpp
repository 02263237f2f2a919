// Jacobians against finite differences of the forces, and the matrix in all the forms it comes in.
#include "sim/linear/stiffness.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "base/random.h"
#include "sim/force/forces.h"
#include "sim/force/spring_force.h"
#include "tests/support/evaluations.h"
#include "tests/support/step_matrix.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::least_eigenvalue;
using test::shaken_state;

Structure sheet(SpringModel model, std::vector<int> pinned = {}) {
  Structure structure = test::light_cloth(4, 3, std::move(pinned));
  structure.body[0].spring_model = model;
  structure.body[0].buckling_rigidity = 1e-4;
  return structure;
}

Eigen::MatrixXd minus_force_differences(const Forces& forces, const State& state, Eigen::MatrixX3d State::*field,
                                        double d) {
  return test::minus_slope([&](const State& at) { return test::force_of(forces, at); }, state, field, d);
}

Eigen::MatrixXd dense(const StiffnessMatrix& matrix) { return Eigen::MatrixXd(matrix.assemble(false)); }

TEST(Jacobian, ExactFormIsMinusTheDerivativeOfTheForceByPosition) {
  for (const SpringModel model : {SpringModel::linear, SpringModel::choi_ko})
    for (const double distance : {0.005, 0.04}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(model) << ", shaken by " << distance << " m");
      const Structure structure = sheet(model);
      const Forces forces(structure, {0.0, -9.81, 0.0});
      const State state = shaken_state(structure, distance, 1.0, 11);
      const Eigen::MatrixXd expected = minus_force_differences(forces, state, &State::position, 1e-7);
      const Eigen::MatrixXd jacobian = dense(forces.linearise(state, 1.0, 0.0, JacobianForm::exact));
      EXPECT_LT((jacobian - expected).norm(), 1e-6 * expected.norm());
    }
}

TEST(Jacobian, IsMinusTheDerivativeOfTheForceByVelocity) {
  for (const DampingModel model : {DampingModel::projected, DampingModel::spring})
    for (const JacobianForm form : {JacobianForm::exact, JacobianForm::definite}) {
      Structure structure = sheet(SpringModel::linear);
      structure.damping = Eigen::VectorXd::LinSpaced(structure.springs(), 0.0, 2.0);
      structure.body[0].damping_model = model;
      structure.body[0].friction = 0.3;
      const Forces forces(structure, {0.0, -9.81, 0.0});
      const State state = shaken_state(structure, 0.03, 1.0);
      const Eigen::MatrixXd expected = minus_force_differences(forces, state, &State::velocity, 1e-3);
      EXPECT_LT((dense(forces.linearise(state, 0.0, 1.0, form)) - expected).norm(), 1e-9 * expected.norm());
    }
}

// Relative damping c w does not know the positions; projected damping does as soon as ends move relative to each other.
TEST(Jacobian, ByPositionIsExactWithDampingAtRestAndWithRelativeDampingAlways) {
  for (const DampingModel model : {DampingModel::projected, DampingModel::spring}) {
    Structure structure = sheet(SpringModel::linear);
    structure.damping.setConstant(2.0);
    structure.body[0].damping_model = model;
    structure.body[0].friction = 0.3;
    const Forces forces(structure, Eigen::Vector3d::Zero());
    const State state = shaken_state(structure, 0.03, model == DampingModel::spring ? 1.0 : 0.0);
    const Eigen::MatrixXd expected = minus_force_differences(forces, state, &State::position, 1e-7);
    EXPECT_LT((dense(forces.linearise(state, 1.0, 0.0, JacobianForm::exact)) - expected).norm(),
              1e-6 * expected.norm());
  }
}

TEST(Jacobian, DefiniteFormHasNoNegativeEigenvalueHoweverCompressed) {
  for (const SpringModel model : {SpringModel::linear, SpringModel::choi_ko})
    for (const double size : {0.3, 0.7, 1.0, 1.4}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(model) << " at " << size << " of its size");
      const Structure structure = sheet(model);
      State state = shaken_state(structure, 0.02, 0.0);
      state.position *= size;
      const Forces forces(structure, Eigen::Vector3d::Zero());
      EXPECT_GT(least_eigenvalue(dense(forces.linearise(state, 1.0, 0.0, JacobianForm::definite))), -1e-10 * 500.0);
    }
}

TEST(Jacobian, FormsDifferOnlyWhereSpringsAreCompressed) {
  const Structure structure = sheet(SpringModel::linear);
  const Forces forces(structure, Eigen::Vector3d::Zero());
  State state = shaken_state(structure, 0.01, 0.0);
  const auto linearised = [&](JacobianForm form) { return dense(forces.linearise(state, 1.0, 0.0, form)); };
  state.position *= 2.0;
  EXPECT_TRUE(linearised(JacobianForm::exact) == linearised(JacobianForm::definite));
  state.position *= 0.25;
  EXPECT_LT(least_eigenvalue(linearised(JacobianForm::exact)), -10.0) << "the case that the definite form is for";
}

TEST(Jacobian, IsSymmetricAndBlindToTranslation) {
  const Structure structure = sheet(SpringModel::choi_ko);
  const Forces forces(structure, Eigen::Vector3d::Zero());
  const StiffnessMatrix matrix = forces.linearise(shaken_state(structure, 0.03, 0.0), 1.0, 0.0, JacobianForm::exact);
  EXPECT_LT((dense(matrix) - dense(matrix).transpose()).norm(), 1e-14 * dense(matrix).norm());
  Eigen::MatrixX3d product;
  matrix.multiply(Eigen::RowVector3d(1.0, 2.0, 3.0).replicate(structure.particles(), 1), product);
  EXPECT_LT(product.norm(), 1e-12 * dense(matrix).norm());
}

StiffnessMatrix random_springs(const Structure& structure, std::uint64_t seed) {
  StiffnessMatrix matrix(structure);
  const Eigen::MatrixX3d noise = seeded_noise(structure.springs() + structure.particles(), seed);
  const Eigen::MatrixX3d directions = seeded_noise(structure.springs(), 99);
  for (int s = 0; s < structure.springs(); ++s)
    matrix.add_spring(s, directions.row(s).normalized(), noise(s, 0), noise(s, 1));
  for (int i = 0; i < structure.particles(); ++i) matrix.add_diagonal(i, noise(structure.springs() + i, 2));
  return matrix;
}

// With blocks between particles that share a spring and that do not, on the diagonal, and twice at one place.
StiffnessMatrix random_matrix(const Structure& structure, std::uint64_t seed) {
  StiffnessMatrix matrix = random_springs(structure, seed);
  for (const auto& [i, j] : {std::pair{0, 0}, {0, 5}, {5, 0}, {2, 7}, {0, 5}, {6, 6}, {10, 1}})
    matrix.add_block(i, j, Eigen::Matrix3d(seeded_noise(3, seed += 10)));
  return matrix;
}

// Both sides as vectors in the assembled order, particle by particle.
Eigen::VectorXd flattened(const Eigen::MatrixX3d& field) { return field.transpose().reshaped(); }

TEST(StiffnessMatrix, AssemblesToWhatItMultipliesBy) {
  const Structure structure = sheet(SpringModel::linear);
  const StiffnessMatrix matrix = random_matrix(structure, 1);
  const Eigen::MatrixX3d x = seeded_noise(structure.particles(), 5);
  Eigen::MatrixX3d product;
  matrix.multiply(x, product);
  EXPECT_LT((dense(matrix) * flattened(x) - flattened(product)).norm(), 1e-13 * product.norm());
}

TEST(StiffnessMatrix, EliminatesPinsAsIdentityRowsAndColumns) {
  const Structure structure = sheet(SpringModel::linear, {0, 3, 7});
  const StiffnessMatrix matrix = random_matrix(structure, 1);
  Eigen::MatrixXd expected = dense(matrix);
  for (int r = 0; r < expected.rows(); ++r)
    for (int c = 0; c < expected.cols(); ++c)
      if (structure.pinned(r / 3) || structure.pinned(c / 3)) expected(r, c) = r == c;
  EXPECT_EQ(Eigen::MatrixXd(matrix.assemble(true)), expected);
}

TEST(StiffnessMatrix, HasTheSamePatternForEveryState) {
  const Structure structure = sheet(SpringModel::linear, {0, 3});
  const Eigen::SparseMatrix<double> zero = StiffnessMatrix(structure).assemble(true);
  const Eigen::SparseMatrix<double> full = random_springs(structure, 1).assemble(true);
  ASSERT_EQ(zero.nonZeros(), full.nonZeros());
  EXPECT_TRUE(std::equal(zero.innerIndexPtr(), zero.innerIndexPtr() + zero.nonZeros(), full.innerIndexPtr()));
}

TEST(StiffnessMatrix, DiagonalBlocksAreTheSymmetricPartsOfTheAssembledOnes) {
  const Structure structure = sheet(SpringModel::linear);
  const StiffnessMatrix matrix = random_matrix(structure, 1);
  Eigen::MatrixX3d straight, mixed;
  matrix.diagonal_blocks(straight, mixed);
  const Eigen::MatrixXd assembled = dense(matrix);
  for (int i = 0; i < structure.particles(); ++i) {
    const Eigen::Matrix3d whole = assembled.block(3 * i, 3 * i, 3, 3), block = 0.5 * (whole + whole.transpose());
    EXPECT_LT((block.diagonal().transpose() - straight.row(i)).norm(), 1e-14);
    EXPECT_LT((Eigen::RowVector3d(block(0, 1), block(0, 2), block(1, 2)) - mixed.row(i)).norm(), 1e-14);
  }
}

TEST(StiffnessMatrix, OneAxisIsTheIsotropicPartAlone) {
  const Structure structure = sheet(SpringModel::linear, {0, 3});
  StiffnessMatrix matrix(structure);
  for (int s = 0; s < structure.springs(); ++s) matrix.add_spring(s, Eigen::Vector3d::Zero(), 1.0 + s, 0.0);
  for (int i = 0; i < structure.particles(); ++i) matrix.add_diagonal(i, 0.5 * i);
  for (const bool eliminate : {false, true}) {
    const Eigen::MatrixXd whole(matrix.assemble(eliminate)), one(matrix.assemble_one_axis(eliminate));
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(one, whole(Eigen::seqN(axis, structure.particles(), 3), Eigen::seqN(axis, structure.particles(), 3)));
  }
}

TEST(StiffnessMatrix, AddsScaledMatricesEntryByEntry) {
  const Structure structure = sheet(SpringModel::linear);
  const StiffnessMatrix a = random_matrix(structure, 1), b = random_matrix(structure, 2);
  StiffnessMatrix sum = a;
  sum.add_scaled(b, -0.7);
  EXPECT_LT((dense(sum) - (dense(a) - 0.7 * dense(b))).norm(), 1e-13);
}

TEST(StiffnessMatrix, HasABlockWhereItWasAddedAndAPairAsASpringHasIt) {
  const Structure structure = sheet(SpringModel::linear);
  const Eigen::Matrix3d block = seeded_noise(3, 4);
  StiffnessMatrix single(structure), pair(structure);
  single.add_block(2, 7, block);
  pair.add_pair(2, 7, block);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(3 * structure.particles(), 3 * structure.particles());
  expected.block(6, 21, 3, 3) = block;
  EXPECT_EQ(dense(single), expected);
  expected.block(6, 21, 3, 3) = expected.block(21, 6, 3, 3) = -block;
  expected.block(6, 6, 3, 3) = expected.block(21, 21, 3, 3) = block;
  EXPECT_EQ(dense(pair), expected);
}

TEST(StiffnessMatrix, ScalesEveryEntry) {
  const Structure structure = sheet(SpringModel::linear);
  StiffnessMatrix matrix = random_matrix(structure, 1);
  matrix.scale(-0.7);
  EXPECT_LT((dense(matrix) + 0.7 * dense(random_matrix(structure, 1))).norm(), 1e-13);
}

TEST(StiffnessMatrix, IsZeroUntilSomethingIsAddedAndAgainAfterSetZero) {
  const Structure structure = sheet(SpringModel::linear);
  StiffnessMatrix diagonal(structure), spring(structure), block(structure);
  for (const StiffnessMatrix* matrix : {&diagonal, &spring, &block}) EXPECT_TRUE(matrix->is_zero());
  diagonal.add_diagonal(3, 1.0);
  spring.add_spring(3, Eigen::Vector3d::UnitX(), 0.0, 1.0);
  block.add_block(3, 4, Eigen::Matrix3d::Identity());
  for (StiffnessMatrix* matrix : {&diagonal, &spring, &block}) {
    EXPECT_FALSE(matrix->is_zero());
    matrix->set_zero();
    EXPECT_TRUE(matrix->is_zero());
    EXPECT_TRUE(dense(*matrix).isZero(0.0));
  }
  block.add_block(3, 4, Eigen::Matrix3d::Zero());
  EXPECT_TRUE(block.is_zero()) << "nothing but zeros";
}

TEST(StiffnessMatrix, HasNoFormForOneAxisWhereBlocksTellAxesApart) {
  const Structure structure = sheet(SpringModel::linear);
  EXPECT_THROW(random_matrix(structure, 1).assemble_one_axis(true), std::logic_error);
}

TEST(LinearisationAtRest, IsTheJacobianThere) {
  Structure structure = sheet(SpringModel::linear);
  structure.damping = Eigen::VectorXd::LinSpaced(structure.springs(), 0.0, 2.0);
  structure.body[0].friction = 0.3;
  for (const DampingModel model : {DampingModel::projected, DampingModel::spring}) {
    structure.body[0].damping_model = model;
    const Forces forces(structure, Eigen::Vector3d::Zero());
    const Linearisation at_rest = linearise_at_rest(structure);
    const State rest = rest_state(structure);
    EXPECT_LT((dense(at_rest.stiffness) - dense(forces.linearise(rest, 1.0, 0.0, JacobianForm::exact))).norm(), 1e-10);
    EXPECT_LT((dense(at_rest.damping) - dense(forces.linearise(rest, 0.0, 1.0, JacobianForm::exact))).norm(), 1e-10);
  }
}

TEST(LinearisationAtRest, CountsSlackSpringsInFull) {
  EXPECT_EQ(dense(linearise_at_rest(sheet(SpringModel::choi_ko)).stiffness),
            dense(linearise_at_rest(sheet(SpringModel::linear)).stiffness));
}

// Folded, crumpled or drawn out: no state's matrix exceeds the bound in any direction. A rigid enough beam is stiffer
// when bent right over than it is straight.
TEST(LinearisationOfAnyShape, IsAnUpperBoundOverStates) {
  for (const SpringModel model : {SpringModel::linear, SpringModel::choi_ko}) {
    Structure structure = sheet(model);
    structure.body[0].buckling_rigidity = 4e-3;
    const Forces forces(structure, Eigen::Vector3d::Zero());
    const Eigen::MatrixXd bound = dense(test::bound_of(structure, Shapes::any).stiffness);
    for (const double distance : {0.01, 0.1, 1.0, 100.0}) {
      const State state = shaken_state(structure, distance, 0.0);
      const Eigen::MatrixXd matrix = dense(forces.linearise(state, 1.0, 0.0, JacobianForm::definite));
      EXPECT_GT(least_eigenvalue(bound - matrix), -1e-10 * 500.0) << static_cast<int>(model) << " " << distance;
    }
  }
}

}  // namespace
}  // namespace billow::sim
