// k0 and the paper's Algorithm 1 against closed forms, a general bound, and two independent eigenvalue solvers.
#include "sim/linear/max_eigenvalue.h"
#include "sim/force/spring_force.h"
#include "sim/limit/filtered_eigenvalue.h"
#include "sim/limit/paper_step.h"

#include <gtest/gtest.h>

#include <Spectra/MatOp/SparseSymMatProd.h>
#include <Spectra/SymEigsSolver.h>
#include <cmath>
#include <numbers>

#include "sim/limit/stiffness_scale.h"
#include "tests/support/evaluations.h"
#include "tests/support/step_matrix.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::dense_dynamics;
using test::fixed_chain;
using test::grid;
using test::spectral_radius;
using test::with_uneven_masses;

EigenvalueEstimate k0(const Structure& structure, const EigenvalueOptions& options = {}) {
  return max_eigenvalue(structure, linearise_at_rest(structure).stiffness, options);
}

// n equal masses between two walls: omega_max = 2 sqrt(k/m) sin(n pi / (2 (n + 1))).
TEST(MaxEigenvalue, MatchesTheClosedFormOfAFixedChain) {
  for (const int n : {1, 2, 7, 40}) {
    SCOPED_TRACE(n);
    const Structure chain = fixed_chain({.free_particles = n, .mass = 0.2, .stiffness = 50.0});
    const EigenvalueEstimate estimate = k0(chain, {.tolerance = 1e-12});
    const double sine = std::sin(n * std::numbers::pi / (2.0 * (n + 1))), exact = 4.0 * 50.0 / 0.2 * sine * sine;
    ASSERT_TRUE(estimate.converged);
    EXPECT_NEAR(estimate.value, exact, 1e-6 * exact);
  }
}

TEST(MaxEigenvalue, FindsTheFastestModeOfAFixedChain) {
  const Structure chain = fixed_chain({.free_particles = 6});
  Eigen::MatrixX3d mode;
  max_eigenvalue(chain, linearise_at_rest(chain).stiffness, {.tolerance = 1e-14}, &mode);
  Eigen::VectorXd exact(8);
  for (int i = 0; i < 8; ++i) exact(i) = std::sin(6.0 * i * std::numbers::pi / 7.0);
  const double along = mode.col(0).normalized().dot(exact.normalized());
  EXPECT_NEAR(std::abs(along), 1.0, 1e-9);
  EXPECT_LT(mode.rightCols<2>().norm(), 1e-9 * mode.norm());
}

/// Sheets whose greatest eigenvalues have nothing to hide behind: masses, pins and stiffness vary.
std::vector<Structure> sheets() {
  Structure stiffer = grid({.width = 9, .height = 5, .spacing = 0.1, .mass = 0.01});
  stiffer.stiffness.head(20) *= 7.0;
  return {grid({.width = 8, .height = 8, .mass = 0.5, .structural = 100.0, .pinned = {0, 7}}),
          with_uneven_masses(grid({.width = 10, .height = 6, .pinned = {3}}), 0.6),
          with_uneven_masses(grid({.width = 6, .height = 6, .shear = 2.0}), 0.2), stiffer,
          merge({grid({.width = 3, .height = 3}), grid({.width = 4, .height = 4, .structural = 5.0})})};
}

TEST(MaxEigenvalue, AgreesWithADenseSolverFromBelow) {
  for (const Structure& structure : sheets()) {
    const EigenvalueEstimate estimate = k0(structure);
    const double exact = spectral_radius(dense_dynamics(structure, linearise_at_rest(structure).stiffness));
    EXPECT_TRUE(estimate.converged);
    EXPECT_NEAR(estimate.value, exact, 1e-5 * exact);
    EXPECT_LE(estimate.value, exact * (1.0 + 1e-12));
  }
}

TEST(MaxEigenvalue, AgreesWithALanczosSolverOnALargeSheet) {
  const Structure structure =
      with_uneven_masses(grid({.width = 40, .height = 40, .mass = 0.01, .structural = 120.0, .pinned = {0, 39}}), 0.3);
  Eigen::SparseMatrix<double> matrix = linearise_at_rest(structure).stiffness.assemble(false);
  Eigen::VectorXd root(matrix.rows());
  for (int r = 0; r < root.size(); ++r) root(r) = std::sqrt(structure.inverse_mass(r / 3));
  matrix = root.asDiagonal() * matrix * root.asDiagonal();
  Spectra::SparseSymMatProd<double> product(matrix);
  Spectra::SymEigsSolver<Spectra::SparseSymMatProd<double>> solver(product, 4, 40);
  solver.init();
  ASSERT_GT(solver.compute(Spectra::SortRule::LargestAlge, 1000, 1e-10), 0);
  const double exact = solver.eigenvalues()(0);
  EXPECT_NEAR(k0(structure).value, exact, 1e-5 * exact);
}

TEST(MaxEigenvalue, StaysBelowTheGeneralBound) {
  for (const Structure& structure : sheets()) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(structure.particles());
    for (int s = 0; s < structure.springs(); ++s)
      for (int end = 0; end < 2; ++end) sum(structure.spring(s, end)) += structure.stiffness(s);
    EXPECT_LE(k0(structure).value, 2.0 * sum.cwiseProduct(structure.inverse_mass).maxCoeff());
  }
}

TEST(MaxEigenvalue, SaysWhenItDidNotConverge) {
  const EigenvalueEstimate estimate = k0(sheets()[0], {.max_iterations = 3, .tolerance = 1e-14});
  EXPECT_FALSE(estimate.converged);
  EXPECT_EQ(estimate.iterations, 3);
}

TEST(MaxEigenvalue, GivesZeroWhenNothingMovesOrNothingResists) {
  EXPECT_EQ(k0(grid({.width = 2, .height = 2, .pinned = {0, 1, 2, 3}})).value, 0.0);
  EXPECT_EQ(k0(grid({.width = 3, .height = 2, .structural = 0.0, .shear = 0.0, .bend = 0.0})).value, 0.0);
}

TEST(MaxEigenvalue, IsTheSameForTheSameSeedAndAgreesBetweenSeeds) {
  const Structure structure = sheets()[1];
  EXPECT_EQ(k0(structure).value, k0(structure).value);
  EXPECT_NEAR(k0(structure, {.seed = 2}).value, k0(structure).value, 1e-5 * k0(structure).value);
}

TEST(StiffnessScale, SetsTheGreatestEigenvalue) {
  for (Structure structure : sheets()) {
    scale_stiffness(structure, 1e6);
    EXPECT_NEAR(spectral_radius(dense_dynamics(structure, linearise_at_rest(structure).stiffness)), 1e6, 10.0);
  }
}

Eigen::MatrixXd dense_filter(const Structure& structure, const Filter& filter) {
  std::vector<int> free;
  for (int i = 0; i < structure.particles(); ++i)
    if (!structure.pinned(i)) free.push_back(i);
  const int size = 3 * static_cast<int>(free.size());
  Eigen::MatrixXd matrix(size, size);
  for (int c = 0; c < size; ++c) {
    Eigen::MatrixX3d unit = Eigen::MatrixX3d::Zero(structure.particles(), 3);
    unit(free[c / 3], c % 3) = 1.0;
    test::apply(filter, structure.rest_position, 0.0, unit);
    for (int r = 0; r < size; ++r) matrix(r, c) = unit(free[r / 3], r % 3);
  }
  return matrix;
}

TEST(Algorithm1, FindsTheSpectralRadiusOfTheFilteredDynamics) {
  for (const Structure& structure : sheets())
    for (const FilterForm form : {FilterForm::plain, FilterForm::symmetric, FilterForm::conserving})
      for (const int passes : {1, 2}) {
        SCOPED_TRACE(testing::Message() << structure.particles() << " particles, form " << static_cast<int>(form)
                                        << ", passes " << passes);
        const Filter filter(structure, {.form = form, .passes = passes});
        const StiffnessMatrix stiffness = linearise_at_rest(structure).stiffness;
        const double exact = spectral_radius(dense_filter(structure, filter) * dense_dynamics(structure, stiffness));
        EXPECT_NEAR(filtered_eigenvalue(structure, stiffness, filter).value, exact, 1e-3 * exact);
      }
}

// A filter so weak that it lets everything pass.
TEST(Algorithm1, EqualsTheGreatestEigenvalueWithoutFiltering) {
  const Structure structure = sheets()[1];
  const Filter filter(structure, {.lambda = 50.0});
  const StiffnessMatrix stiffness = linearise_at_rest(structure).stiffness;
  EXPECT_NEAR(filtered_eigenvalue(structure, stiffness, filter).value, k0(structure).value, 1e-4 * k0(structure).value);
}

TEST(PaperStep, IsEquation11) {
  for (const Method method : {Method::forward_euler, Method::fb_euler, Method::verlet})
    EXPECT_DOUBLE_EQ(paper_step(method, 1e6).value(), 0.002);
  EXPECT_DOUBLE_EQ(paper_step(Method::rk4, 1e6).value(), 2.0 * std::numbers::sqrt2 * 1e-3);
  for (const Method method : {Method::backward_euler, Method::imex}) EXPECT_FALSE(paper_step(method, 1e6).has_value());
  EXPECT_FALSE(paper_step(Method::fb_euler, 0.0).has_value());
}

}  // namespace
}  // namespace billow::sim
