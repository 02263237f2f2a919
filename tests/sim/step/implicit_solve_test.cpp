// What an implicit step's solve leaves unsolved must not feed the motion, and a solve that fails goes to Cholesky.
#include "sim/step/implicit_solve.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>

#include "base/random.h"
#include "sim/body/momenta.h"
#include "sim/step/step.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::grid;

/// M + a random positive semidefinite matrix of the given size that leaves half of all motions free.
class RandomMatrix : public ImplicitMatrix {
 public:
  RandomMatrix(const Structure& structure, double size) : mass_(structure.mass) {
    const int n = 3 * structure.particles();
    const Eigen::MatrixX3d noise = seeded_noise(n * n / 6, 4);
    const Eigen::MatrixXd root = Eigen::Map<const Eigen::MatrixXd>(noise.data(), n, n / 2);
    matrix = size / n * root * root.transpose();
    const Eigen::MatrixXd gram = root.transpose() * root;
    free_ = Eigen::MatrixXd::Identity(n, n) - root * gram.llt().solve(root.transpose());
    matrix.diagonal() += mass_.replicate(3, 1);
  }
  void multiply(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) const override {
    y = (matrix * x.reshaped()).reshaped(x.rows(), 3);
  }
  void precondition(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) const override { y = x; }
  bool solve_directly(const Eigen::MatrixX3d& b, Eigen::MatrixX3d& x) override {
    x = matrix.llt().solve(b.reshaped().eval()).reshaped(b.rows(), 3);
    return true;
  }
  bool linearised() const override { return false; }

  /// What of x the matrix' second part does not see.
  Eigen::MatrixX3d free_part(const Eigen::MatrixX3d& x) const { return (free_ * x.reshaped()).reshaped(x.rows(), 3); }
  double mass_square(const Eigen::MatrixX3d& x) const { return x.cwiseAbs2().rowwise().sum().dot(mass_); }

  Eigen::MatrixXd matrix;

 private:
  Eigen::VectorXd mass_;
  Eigen::MatrixXd free_;
};

// - v'.r <= 1/2 dv.M dv + 1/2 (v'.A v' - v'.M v'), whatever tolerance was asked for. Many of
// these solves break it at their tolerance: the velocity is large against its change, and no spring holds it.
TEST(ImplicitSolve, LeavesNothingThatAddsEnergy) {
  const Structure structure = grid({.width = 4, .height = 3, .mass = 0.1});
  RandomMatrix matrix(structure, 10.0);
  ImplicitSolve solve(structure, {.tolerance = 0.4}, matrix);
  for (int seed = 1; seed <= 40; ++seed) {
    const Eigen::MatrixX3d old = 30000.0 * matrix.free_part(seeded_noise(12, seed));
    Eigen::MatrixX3d b = seeded_noise(12, 100 + seed);
    Eigen::MatrixX3d velocity, product;
    solve.solve(old, b, velocity);
    const Eigen::MatrixX3d change = velocity - old;
    matrix.multiply(change, product);
    const double gain = -velocity.cwiseProduct(b - product).sum();
    matrix.multiply(velocity, product);
    const double loss =
        0.5 * (matrix.mass_square(change) + velocity.cwiseProduct(product).sum() - matrix.mass_square(velocity));
    EXPECT_LE(gain, loss + 1e-9 * matrix.mass_square(velocity)) << seed;
  }
  EXPECT_EQ(solve.counts().solves, 40);
  EXPECT_GT(solve.counts().tightened, 10);
  EXPECT_EQ(solve.counts().failures, 0);
}

/// A square metre of 0.2 kg that hangs from one corner, as stiff as wire.
Structure stiff_sheet(double stiffness) {
  return grid({.width = 8,
               .height = 8,
               .spacing = 1.0 / 7.0,
               .mass = 0.2 / 64.0,
               .structural = stiffness,
               .shear = stiffness,
               .bend = stiffness,
               .pinned = {0}});
}

struct EnergyOfARun {
  double peak = 0.0;   // [J] above where it began
  double climb = 0.0;  // [J] the most within a step
  SolveCounts counts = {};
};

EnergyOfARun fall(const Structure& structure, Method method, LinearSolver solver, double h, double duration) {
  const Forces forces(structure, {0.0, -9.81, 0.0});
  Step step(forces, method, {.linear_solver = solver}, nullptr);
  State state = rest_state(structure);
  const double begin = forces.potential_energy(state);
  double last = begin;
  EnergyOfARun run;
  for (int k = 0; k < duration / h; ++k) {
    step(state, h);
    const double energy = kinetic_energy(structure, state) + forces.potential_energy(state);
    run.peak = std::max(run.peak, energy - begin);
    run.climb = std::max(run.climb, energy - last);
    last = energy;
  }
  run.counts = step.solve_counts();
  return run;
}

constexpr double turned_over = 0.2 * 9.81;  // [J] the weight times the size
constexpr LinearSolver both_solvers[] = {LinearSolver::conjugate_gradient, LinearSolver::cholesky};

TEST(ImplicitSolve, BackwardEulerNeverGainsEnergyOnASheetOfStiffCloth) {
  for (const double damping : {0.0, 0.05})
    for (const double stiffness : {1e2, 1e4, 1e6})
      for (const LinearSolver solver : both_solvers) {
        Structure sheet = stiff_sheet(stiffness);
        sheet.damping.setConstant(damping);
        const EnergyOfARun run = fall(sheet, Method::backward_euler, solver, 0.01, 10.0);
        EXPECT_LE(run.climb, 1e-6 * turned_over) << stiffness << ", " << damping << ", " << static_cast<int>(solver);
        EXPECT_EQ(run.counts.failures, 0);
      }
}

// From here on even an exact step climbs a little, by how its springs turn within it. What the conjugate gradient
// leaves, which was a hundred million joules once, must not show beside that.
TEST(ImplicitSolve, BackwardEulerKeepsToTheExactStepsEnergyOnASheetOfWire) {
  for (const double stiffness : {1e7, 1e8, 1e9}) {
    SCOPED_TRACE(stiffness);
    const Structure sheet = stiff_sheet(stiffness);
    const EnergyOfARun exact = fall(sheet, Method::backward_euler, LinearSolver::cholesky, 0.01, 10.0);
    const EnergyOfARun run = fall(sheet, Method::backward_euler, LinearSolver::conjugate_gradient, 0.01, 10.0);
    EXPECT_LE(run.peak, 1.1 * exact.peak);
    EXPECT_LE(run.climb, 1.1 * exact.climb);
    EXPECT_LE(exact.peak, (stiffness > 1e8 ? 0.5 : 0.06) * turned_over);
    EXPECT_GT(run.counts.tightened, 100);
    EXPECT_EQ(run.counts.by_cholesky, 0);
    EXPECT_EQ(run.counts.failures, 0);
  }
}

TEST(ImplicitSolve, ImexNeverGainsEnergyHoweverStiff) {
  for (const double h : {0.01, 0.04})
    for (const double stiffness : {1e2, 1e6, 1e8})
      for (const LinearSolver solver : both_solvers) {
        const EnergyOfARun run = fall(stiff_sheet(stiffness), Method::imex, solver, h, 10.0);
        EXPECT_LE(run.climb, 1e-6 * turned_over) << stiffness << ", " << h << ", " << static_cast<int>(solver);
        EXPECT_EQ(run.counts.failures, 0);
      }
}

// An ordinary cloth pays nothing for the looking.
TEST(ImplicitSolve, HardlyEverTightensOnAnOrdinaryCloth) {
  for (const Method method : {Method::backward_euler, Method::imex}) {
    const EnergyOfARun run =
        fall(test::light_cloth(10, 10, {0, 9}), method, LinearSolver::conjugate_gradient, 0.01, 5.0);
    EXPECT_LE(run.counts.tightened, run.counts.solves / 50) << name(method);
    EXPECT_EQ(run.counts.by_cholesky, 0) << name(method);
  }
}

State after_a_step(const Forces& forces, Method method, const IntegratorOptions& options, State state,
                   SolveCounts& counts) {
  Step step(forces, method, options, nullptr);
  step(state, 0.01);
  counts = step.solve_counts();
  return state;
}

// Too few iterations, and velocities whose squares are infinite or zero.
TEST(ImplicitSolve, HandsWhatItCannotSolveToCholesky) {
  const Structure chain = test::fixed_chain({});
  const Forces forces(chain, Eigen::Vector3d::Zero());
  for (const Method method : {Method::backward_euler, Method::imex})
    for (const double speed : {1.0, 1e200, 1e-200}) {
      SCOPED_TRACE(testing::Message() << name(method) << " at " << speed);
      State start = rest_state(chain);
      start.velocity = speed * test::shaken_state(chain, 0.0, 1.0).velocity;
      SolveCounts counts;
      const State direct = after_a_step(forces, method, {.linear_solver = LinearSolver::cholesky}, start, counts);
      EXPECT_EQ(counts.by_cholesky, 0);
      const IntegratorOptions hasty{.tolerance = 1e-10, .max_iterations = 1};
      const State end = after_a_step(forces, method, speed == 1.0 ? hasty : IntegratorOptions{}, start, counts);
      EXPECT_EQ(end.velocity, direct.velocity);
      EXPECT_TRUE(end.velocity.allFinite());
      EXPECT_EQ(counts.by_cholesky, 1);
      EXPECT_EQ(counts.failures, 0);
    }
}

TEST(ImplicitSolve, CountsAFailureWhereCholeskyFailsTooAndAddsNoNumbersThatAreNone) {
  const Structure chain = test::fixed_chain({});
  const Forces forces(chain, Eigen::Vector3d::Zero());
  State start = rest_state(chain);
  start.velocity = test::shaken_state(chain, 0.0, 1.0).velocity;
  start.position(3, 0) = std::numeric_limits<double>::quiet_NaN();
  for (const Method method : {Method::backward_euler, Method::imex})
    for (const LinearSolver solver : both_solvers) {
      SolveCounts counts;
      const State end = after_a_step(forces, method, {.linear_solver = solver}, start, counts);
      EXPECT_TRUE(end.velocity.allFinite()) << name(method);
      EXPECT_EQ(counts.failures, 1) << name(method);
      EXPECT_EQ(counts.by_cholesky, solver == LinearSolver::conjugate_gradient) << name(method);
    }
}

}  // namespace
}  // namespace billow::sim
