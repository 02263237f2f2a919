// Backward Euler's preconditioner: positive definite, near the inverse, and gone where it does not pay.
#include "sim/step/two_level.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>

#include "sim/force/forces.h"
#include "sim/linear/conjugate_gradient.h"
#include "sim/linear/sparse_cholesky.h"
#include "sim/step/step.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

constexpr long many = 1000, few = 1;  // iterations that call for the coarse level, and that do not

Structure two_sheets(double stiffness) {
  Structure both = merge({test::light_cloth(10, 13, {0, 9}), test::light_cloth(12, 12, {5})});
  both.stiffness *= stiffness;
  return both;
}

StiffnessMatrix matrix_at(const Structure& structure, double distance) {
  const Forces forces(structure, {0.0, -9.81, 0.0});
  StiffnessMatrix matrix =
      forces.linearise(test::shaken_state(structure, distance, 0.0), 1e-4, 0.0, JacobianForm::definite);
  for (int i = 0; i < structure.particles(); ++i) matrix.add_diagonal(i, structure.mass(i));
  return matrix;
}

TEST(TwoLevel, IsSymmetricAndPositiveDefiniteWithMatricesOfAnyAge) {
  const Structure structure = two_sheets(1e4);
  TwoLevel preconditioner(structure);
  preconditioner.set(matrix_at(structure, 0.001), many);
  preconditioner.set(matrix_at(structure, 0.02), many);
  const int n = structure.particles();
  Eigen::MatrixXd b(3 * n, 3 * n);
  Eigen::MatrixX3d y;
  for (int k = 0; k < 3 * n; ++k) {
    const Eigen::MatrixX3d x = Eigen::VectorXd::Unit(3 * n, k).reshaped(n, 3);
    preconditioner.apply(x, y);
    b.col(k) = y.reshaped();
  }
  EXPECT_LT((b - b.transpose()).norm(), 1e-12 * b.norm());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(b, Eigen::EigenvaluesOnly).eigenvalues().minCoeff(), 0.0);
}

/// x with A x = b, and the iterations that it took.
std::pair<Eigen::MatrixX3d, int> solved(const Structure& structure, const StiffnessMatrix& matrix, long iterations,
                                        const Eigen::MatrixX3d& b) {
  TwoLevel preconditioner(structure);
  preconditioner.set(matrix, iterations);
  const LinearSystem system{[&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
                              matrix.multiply(x, y);
                              for (int i = 0; i < structure.particles(); ++i)
                                if (structure.pinned(i)) y.row(i).setZero();
                            },
                            [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) { preconditioner.apply(x, y); }};
  Eigen::MatrixX3d x = Eigen::MatrixX3d::Zero(b.rows(), 3);
  ConjugateGradient gradient;
  gradient.start(system, b, x);
  EXPECT_EQ(gradient.solve(1e-10, 5000), SolveState::converged);
  return {x, gradient.iterations()};
}

TEST(TwoLevel, SolvesAsCholeskyDoesInHalfTheIterations) {
  const Structure structure = two_sheets(1e4);
  const StiffnessMatrix matrix = matrix_at(structure, 0.001);
  Eigen::MatrixX3d b = test::shaken_state(structure, 0.0, 1.0, 5).velocity;  // zero at pinned particles
  b.col(0).array() += (structure.inverse_mass.array() > 0.0).cast<double>();
  SparseCholesky factor;
  ASSERT_TRUE(factor.factorise(matrix.assemble(true)));
  const Eigen::VectorXd rows = factor.solve(b.transpose().reshaped().eval());
  const Eigen::MatrixX3d exact = rows.reshaped(3, b.rows()).transpose();
  const auto [x, iterations] = solved(structure, matrix, many, b);
  const auto [x_by_blocks, iterations_by_blocks] = solved(structure, matrix, few, b);
  EXPECT_LT((x - exact).norm(), 1e-7 * exact.norm());
  EXPECT_LT((x_by_blocks - exact).norm(), 1e-7 * exact.norm());
  EXPECT_LT(2 * iterations, iterations_by_blocks);
}

TEST(TwoLevel, IsBlockJacobiAloneWhereSolvesTakeFewIterations) {
  const Structure structure = two_sheets(1.0);
  const StiffnessMatrix matrix = matrix_at(structure, 0.001);
  const Eigen::MatrixX3d x = test::shaken_state(structure, 0.0, 1.0, 5).velocity;
  TwoLevel preconditioner(structure);
  BlockJacobi blocks;
  blocks.set(matrix);
  Eigen::MatrixX3d y, expected;
  blocks.apply(x, expected);
  for (const auto& [iterations, alone] : {std::pair(few, true), {many, false}, {few, true}}) {
    preconditioner.set(matrix, iterations);
    preconditioner.apply(x, y);
    EXPECT_EQ(y == expected, alone);
  }
}

// Coming back, coarse matrices are those of the state at hand, however young they were when they went.
TEST(TwoLevel, RenewsItsCoarseMatricesWhenItComesBack) {
  const Structure structure = two_sheets(1e4);
  const StiffnessMatrix before = matrix_at(structure, 0.001), after = matrix_at(structure, 0.02);
  const Eigen::MatrixX3d x = test::shaken_state(structure, 0.0, 1.0, 5).velocity;
  TwoLevel old(structure), fresh(structure);
  old.set(before, many);
  old.set(before, few);
  old.set(after, many);
  fresh.set(after, many);
  Eigen::MatrixX3d y, expected;
  old.apply(x, y);
  fresh.apply(x, expected);
  EXPECT_EQ(y, expected);
}

// A stiff sheet's steps, each with the preconditioner that the steps before it led to.
TEST(TwoLevel, TakesAStiffSheetWhereCholeskyTakesIt) {
  Structure sheet = test::light_cloth(16, 16, {0, 15});
  sheet.stiffness *= 1e4;
  const Forces forces(sheet, {0.0, -9.81, 0.0});
  std::array<State, 2> state{rest_state(sheet), rest_state(sheet)};
  Step by_gradient(forces, Method::backward_euler, {.tolerance = 1e-8}, nullptr);
  Step by_cholesky(forces, Method::backward_euler, {.linear_solver = LinearSolver::cholesky}, nullptr);
  for (int k = 0; k < 50; ++k) by_gradient(state[0], 0.01), by_cholesky(state[1], 0.01);
  EXPECT_LT((state[0].position - state[1].position).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_EQ(by_gradient.solve_counts().by_cholesky, 0);
}

}  // namespace
}  // namespace billow::sim
