// Extreme eigenvalues against closed forms and dense solvers, and their error bounds against the truth.
#include "sim/linear/lanczos.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "sim/force/spring_force.h"
#include "sim/linear/arnoldi.h"
#include "tests/support/step_matrix.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::grid;

/// weight M^-1 K - shift
SymmetricProduct dynamics(const Structure& structure, const StiffnessMatrix& stiffness, double weight = 1.0,
                          double shift = 0.0) {
  return {[&structure, &stiffness, weight, shift](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
            stiffness.multiply(x, y);
            y = weight * (structure.inverse_mass.asDiagonal() * y) - shift * x;
          },
          {},
          free_mass(structure)};
}

Structure uneven_sheet() { return test::with_uneven_masses(grid({.width = 7, .height = 6, .pinned = {0, 6}}), 0.5); }

TEST(Lanczos, MatchesTheClosedFormOfAFixedChain) {
  const Structure chain = test::fixed_chain({.free_particles = 40, .mass = 0.2, .stiffness = 50.0});
  const StiffnessMatrix stiffness = linearise_at_rest(chain).stiffness;
  const double sine = std::sin(40.0 * std::numbers::pi / 82.0), exact = 4.0 * 50.0 / 0.2 * sine * sine;
  const ExtremeEigenvalue found = largest_eigenvalue(dynamics(chain, stiffness), {.tolerance = 1e-9});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.value, exact, 1e-12 * exact);
}

// From below, and never farther below than the bound says, however early it stops.
TEST(Lanczos, HasABoundThatHolds) {
  const Structure structure = uneven_sheet();
  const StiffnessMatrix stiffness = linearise_at_rest(structure).stiffness;
  const double exact = test::spectral_radius(test::dense_dynamics(structure, stiffness));
  for (const double tolerance : {0.1, 1e-2, 1e-4, 1e-8}) {
    const ExtremeEigenvalue found = largest_eigenvalue(dynamics(structure, stiffness), {.tolerance = tolerance});
    EXPECT_TRUE(found.converged);
    EXPECT_LE(found.error, tolerance * found.value);
    EXPECT_LE(found.value, exact * (1.0 + 1e-12));
    EXPECT_GE(found.upper(), exact * (1.0 - 1e-12)) << tolerance;
  }
}

TEST(Lanczos, FindsTheLargestNotTheLargestInMagnitude) {
  const Structure structure = uneven_sheet();
  const StiffnessMatrix stiffness = linearise_at_rest(structure).stiffness;
  const Eigen::MatrixXd dense = test::dense_dynamics(structure, stiffness);
  const double top = test::spectral_radius(dense);
  const ExtremeEigenvalue found =
      largest_eigenvalue(dynamics(structure, stiffness, -1.0, -0.9 * top), {.tolerance = 1e-8});
  // The sheet is flat: across it nothing resists, so the least eigenvalue of K is 0.
  EXPECT_NEAR(found.value, 0.9 * top, 1e-9 * top);
}

// The eigenvalues of B G, G > 0, are those of G^1/2 B G^1/2; here both are dense.
TEST(Lanczos, FindsTheLargestEigenvalueOfAProduct) {
  const Structure structure = uneven_sheet();
  const StiffnessMatrix stiffness = linearise_at_rest(structure).stiffness;
  const Eigen::MatrixXd a = test::dense_dynamics(structure, stiffness);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(a.rows(), a.cols());
  const double scale = test::spectral_radius(a);
  SymmetricProduct product = dynamics(structure, stiffness, 1.0, 0.3 * scale);
  product.inner = [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {  // I - A / 2 |A|
    stiffness.multiply(x, y);
    y = x - 0.5 / scale * (structure.inverse_mass.asDiagonal() * y);
  };
  const Eigen::MatrixXd dense = (a - 0.3 * scale * identity) * (identity - 0.5 / scale * a);
  const double exact = Eigen::EigenSolver<Eigen::MatrixXd>(dense, false).eigenvalues().real().maxCoeff();
  Eigen::MatrixX3d vector, image;
  const ExtremeEigenvalue found = largest_eigenvalue(product, {.tolerance = 1e-8}, &vector);
  EXPECT_NEAR(found.value, exact, 1e-8 * scale);
  product.outer(vector, image);  // G B (G x) = value (G x)
  Eigen::MatrixX3d weighted;
  product.inner(image, weighted);
  EXPECT_LE((weighted - found.value * vector).norm(), 1e-6 * scale * vector.norm());
}

TEST(Lanczos, GivesZeroWhereNothingMovesOrNothingResists) {
  const Structure held = grid({.width = 2, .height = 2, .pinned = {0, 1, 2, 3}});
  const StiffnessMatrix stiff = linearise_at_rest(held).stiffness;
  EXPECT_EQ(largest_eigenvalue(dynamics(held, stiff)).upper(), 0.0);
  const Structure slack = grid({.width = 3, .height = 2, .structural = 0.0, .shear = 0.0, .bend = 0.0});
  const StiffnessMatrix none = linearise_at_rest(slack).stiffness;
  const ExtremeEigenvalue found = largest_eigenvalue(dynamics(slack, none));
  EXPECT_TRUE(found.converged);
  EXPECT_EQ(found.upper(), 0.0);
}

TEST(Lanczos, SaysWhenItDidNotConverge) {
  const Structure structure = uneven_sheet();
  const StiffnessMatrix stiffness = linearise_at_rest(structure).stiffness;
  const ExtremeEigenvalue found =
      largest_eigenvalue(dynamics(structure, stiffness), {.tolerance = 1e-14, .max_iterations = 5});
  EXPECT_FALSE(found.converged);
  EXPECT_EQ(found.iterations, 5);
}

// Rotated against each other, two symmetric matrices have a product with complex eigenvalues.
TEST(Arnoldi, AgreesWithADenseSolverOnAMatrixThatIsNotSymmetric) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const int n = 30;
    const Eigen::MatrixXd matrix =
        Eigen::MatrixXd::Random(3 * n, 3 * n) + 4.0 * Eigen::MatrixXd::Identity(3 * n, 3 * n);
    const auto multiply = [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
      const Eigen::VectorXd product = matrix * x.reshaped();
      y = product.reshaped(n, 3);
    };
    const LargestModulus found = largest_modulus(multiply, Eigen::VectorXd::Ones(n), {.tolerance = 1e-6, .seed = seed});
    EXPECT_NEAR(found.value, test::spectral_radius(matrix), 1e-3 * found.value);
  }
}

TEST(Arnoldi, SaysThatTheOperatorGivesNoNumber) {
  const auto multiply = [](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) { y = NAN * x; };
  const LargestModulus found = largest_modulus(multiply, Eigen::VectorXd::Ones(9));
  EXPECT_FALSE(found.converged);
  EXPECT_TRUE(std::isnan(found.value));
}

TEST(Arnoldi, LeavesPinnedRowsAlone) {
  const Structure structure = uneven_sheet();
  const StiffnessMatrix stiffness = linearise_at_rest(structure).stiffness;
  const SymmetricProduct product = dynamics(structure, stiffness);
  const LargestModulus found = largest_modulus(product.outer, free_mass(structure));
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.value, test::spectral_radius(test::dense_dynamics(structure, stiffness)), 1e-6 * found.value);
}

}  // namespace
}  // namespace billow::sim
