// The conjugate gradient against dense solves, and what it says where it cannot solve.
#include "sim/linear/conjugate_gradient.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "base/random.h"

namespace billow::sim {
namespace {

constexpr int unlimited = 3000;

/// A random symmetric positive definite system on n particles; eigenvalues from 1, or spread over `decades`.
struct System {
  explicit System(int n, double decades = 0.0) {
    const Eigen::MatrixX3d noise = seeded_noise(3 * n * n, 4);
    const Eigen::MatrixXd root = Eigen::Map<const Eigen::MatrixXd>(noise.data(), 3 * n, 3 * n);
    Eigen::VectorXd scale(3 * n);
    for (int i = 0; i < 3 * n; ++i) scale(i) = std::pow(10.0, decades * i / (3 * n));
    matrix = root * scale.asDiagonal() * root.transpose() + Eigen::MatrixXd::Identity(3 * n, 3 * n);
    right = seeded_noise(n, 6);
    linear.multiply = [this](const Eigen::MatrixX3d& in, Eigen::MatrixX3d& out) {
      out = (matrix * in.reshaped()).reshaped(in.rows(), 3);
    };
    linear.precondition = [this](const Eigen::MatrixX3d& in, Eigen::MatrixX3d& out) {
      out = in.reshaped().cwiseQuotient(matrix.diagonal().cwiseAbs()).reshaped(in.rows(), 3);
    };
  }
  System(const System&) = delete;

  SolveState solve(double tolerance, int max_iterations, Eigen::MatrixX3d& x) {
    gradient.start(linear, right, x);
    return gradient.solve(tolerance, max_iterations);
  }
  double residual(const Eigen::MatrixX3d& x) const { return (right.reshaped() - matrix * x.reshaped()).norm(); }

  Eigen::MatrixXd matrix;
  Eigen::MatrixX3d right;
  LinearSystem linear;
  ConjugateGradient gradient;
};

Eigen::MatrixX3d zero(int n) { return Eigen::MatrixX3d::Zero(n, 3); }

TEST(ConjugateGradient, SolvesToTheToleranceItPromisesFromAnyStart) {
  System system(15);
  for (const double tolerance : {0.1, 0.01, 1e-6, 1e-10})
    for (const double start : {0.0, 1.0, 1e3}) {
      Eigen::MatrixX3d x = start * seeded_noise(15, 9);
      EXPECT_EQ(system.solve(tolerance, 1000, x), SolveState::converged);
      EXPECT_LE(system.residual(x), 1.01 * tolerance * system.right.norm());
    }
}

TEST(ConjugateGradient, SaysWhenItRanOutOfIterations) {
  System system(15);
  Eigen::MatrixX3d x = zero(15);
  EXPECT_EQ(system.solve(1e-12, 3, x), SolveState::out_of_iterations);
  EXPECT_EQ(system.gradient.iterations(), 3);
}

TEST(ConjugateGradient, StopsAtOnceWhenTheStartIsTheSolution) {
  System system(5);
  Eigen::MatrixX3d x = system.matrix.llt().solve(system.right.reshaped().eval()).reshaped(5, 3);
  EXPECT_EQ(system.solve(1e-6, 100, x), SolveState::converged);
  EXPECT_EQ(system.gradient.iterations(), 0);
}

// No residual is small relative to a right-hand side of zero, so the last step's change must not be taken as a guess.
TEST(ConjugateGradient, GivesZeroForARightHandSideOfZero) {
  System system(5);
  system.right.setZero();
  Eigen::MatrixX3d x = seeded_noise(5, 9);
  EXPECT_EQ(system.solve(0.01, 1000, x), SolveState::converged);
  EXPECT_TRUE(x.isZero(0.0));
  EXPECT_TRUE(system.gradient.residual().isZero(0.0));
}

TEST(ConjugateGradient, GoesOnToASmallerToleranceWhereItStopped) {
  System system(15);
  Eigen::MatrixX3d at_once = zero(15), in_stages = at_once;
  ASSERT_EQ(system.solve(1e-5, 1000, at_once), SolveState::converged);
  const int iterations = system.gradient.iterations();
  ASSERT_EQ(system.solve(0.1, 1000, in_stages), SolveState::converged);
  EXPECT_LT(system.gradient.iterations(), iterations);
  ASSERT_EQ(system.gradient.solve(1e-5, 1000), SolveState::converged);
  EXPECT_EQ(system.gradient.iterations(), iterations);
  EXPECT_EQ(in_stages, at_once);
  EXPECT_LT(
      (system.gradient.residual().reshaped() + system.matrix * in_stages.reshaped() - system.right.reshaped()).norm(),
      1e-12 * system.right.norm());
}

// The numbers that it iterates on lose touch with b - A x where the condition number is large.
TEST(ConjugateGradient, NeverTakesItsOwnRoundingForASolution) {
  int converged = 0, refused = 0;
  for (const double decades : {2.0, 6.0, 9.0, 12.0}) {
    System system(10, decades);
    for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
      Eigen::MatrixX3d x = 1e3 * seeded_noise(10, 9);
      const SolveState end = system.solve(tolerance, unlimited, x);
      (end == SolveState::converged ? converged : refused) += 1;
      if (end == SolveState::converged) {
        EXPECT_LE(system.residual(x), 1.01 * tolerance * system.right.norm()) << decades << ", " << tolerance;
      }
      EXPECT_TRUE(x.allFinite());
    }
  }
  EXPECT_GT(converged, 5);
  EXPECT_GT(refused, 1);
}

TEST(ConjugateGradient, BreaksDownOnAMatrixThatIsNotPositiveDefinite) {
  for (const double shift : {-1.0, -30.0, -1e6}) {
    System system(5);
    system.matrix += shift * (system.matrix.trace() / 15.0) * Eigen::MatrixXd::Identity(15, 15);
    Eigen::MatrixX3d x = zero(5);
    EXPECT_EQ(system.solve(1e-10, unlimited, x), SolveState::breakdown) << shift;
    EXPECT_TRUE(x.allFinite()) << shift;
  }
  System system(5);
  system.matrix.setZero();
  system.linear.precondition = [](const Eigen::MatrixX3d& in, Eigen::MatrixX3d& out) { out = in; };
  Eigen::MatrixX3d x = zero(5);
  EXPECT_EQ(system.solve(0.01, unlimited, x), SolveState::breakdown);
  EXPECT_TRUE(x.isZero(0.0));
}

// Squares of these are infinite, zero, or too coarse to be compared.
TEST(ConjugateGradient, BreaksDownOnARightHandSideItCannotMeasure) {
  for (const double size : {1e160, 1e200, 1e300, 1e-160, 1e-170, 1e-300, std::numeric_limits<double>::infinity(),
                            std::numeric_limits<double>::quiet_NaN()}) {
    System system(5);
    system.right *= size;
    Eigen::MatrixX3d x = seeded_noise(5, 9);
    EXPECT_EQ(system.solve(0.01, unlimited, x), SolveState::breakdown) << size;
    EXPECT_TRUE(x.allFinite()) << size;
  }
}

TEST(ConjugateGradient, DropsAGuessThatIsNotFinite) {
  for (const double wrong :
       {1e200, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    System system(5);
    Eigen::MatrixX3d x = seeded_noise(5, 9);
    x(2, 1) = wrong;
    EXPECT_EQ(system.solve(1e-8, unlimited, x), SolveState::converged) << wrong;
    EXPECT_LE(system.residual(x), 1.01e-8 * system.right.norm()) << wrong;
  }
}

}  // namespace
}  // namespace billow::sim
