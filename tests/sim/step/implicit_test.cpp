// The implicit schemes and their linear solves against the equations they solve, written out densely.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "sim/limit/stiffness_scale.h"
#include "sim/step/step.h"
#include "tests/support/evaluations.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::grid;
using test::shaken_state;

Structure sheet() {
  Structure structure = test::light_cloth(5, 4, {0, 4});
  structure.damping.setConstant(0.05);
  structure.body[0].friction = 0.002;
  return structure;
}

State run(const Structure& structure, Method method, const IntegratorOptions& options, State state, double h, int steps,
          SolveCounts* counts = nullptr) {
  const Forces forces(structure, {0.0, -9.81, 0.0});
  Step step(forces, method, options, nullptr);
  for (int k = 0; k < steps; ++k) step(state, h);
  if (counts) *counts = step.solve_counts();
  return state;
}

Eigen::VectorXd flattened(const Eigen::MatrixX3d& field) { return field.transpose().reshaped(); }

// The change of velocity by `matrix` dv = `right`, pinned rows and columns left out.
Eigen::VectorXd solved_without_pins(const Structure& structure, Eigen::MatrixXd matrix, Eigen::VectorXd right) {
  for (int r = 0; r < matrix.rows(); ++r) {
    if (!structure.pinned(r / 3)) continue;
    matrix.row(r).setZero();
    matrix.col(r).setZero();
    matrix(r, r) = 1.0;
    right(r) = 0.0;
  }
  return matrix.partialPivLu().solve(right);
}

Eigen::MatrixXd mass_matrix(const Structure& structure) {
  return structure.mass.replicate(1, 3).transpose().reshaped().asDiagonal();
}

// Baraff & Witkin's (M - h df/dv - h^2 df/dx) dv = h (f + h df/dx v), the Jacobians by differences of the forces. Every
// spring is stretched, where nothing is dropped from them, and damping is relative, which does not turn with its
// spring.
TEST(BackwardEuler, SolvesTheEquationOfBaraffAndWitkin) {
  Structure structure = sheet();
  structure.body[0].damping_model = DampingModel::spring;
  const Forces forces(structure, {0.0, -9.81, 0.0});
  State state = shaken_state(structure, 0.01, 1.0);
  state.position *= 1.6;
  const auto force_at = [&](const State& at) { return test::force_of(forces, at); };
  const Eigen::MatrixXd by_position = -test::minus_slope(force_at, state, &State::position, 1e-6);
  const Eigen::MatrixXd by_velocity = -test::minus_slope(force_at, state, &State::velocity, 1e-6);
  const double h = 0.01;
  const Eigen::MatrixX3d force = test::force_of(forces, state);
  const Eigen::VectorXd change =
      solved_without_pins(structure, mass_matrix(structure) - h * by_velocity - h * h * by_position,
                          h * (flattened(force) + h * by_position * flattened(state.velocity)));
  for (const LinearSolver solver : {LinearSolver::conjugate_gradient, LinearSolver::cholesky}) {
    const State end =
        run(structure, Method::backward_euler, {.linear_solver = solver, .tolerance = 1e-12}, state, h, 1);
    EXPECT_LT((flattened(end.velocity - state.velocity) - change).norm(), 1e-6 * change.norm());
    EXPECT_LT((end.position - state.position - h * end.velocity).norm(), 1e-14);
  }
}

// (M + h C_L + h^2 K_L) dv = h f - h^2 K_L v with K_L = sum k (1 -1; -1 1) and C_L alike, on each axis.
TEST(Imex, TakesTheLinearPartOfEverySpringImplicitly) {
  const Structure structure = sheet();
  const Forces forces(structure, {0.0, -9.81, 0.0});
  const State state = shaken_state(structure, 0.03, 1.0);
  const int n = structure.particles();
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(3 * n, 3 * n), damping = stiffness;
  for (int s = 0; s < structure.springs(); ++s)
    for (int axis = 0; axis < 3; ++axis) {
      const int i = 3 * structure.spring(s, 0) + axis, j = 3 * structure.spring(s, 1) + axis;
      for (const auto& [r, c, sign] : {std::tuple{i, i, 1.0}, {j, j, 1.0}, {i, j, -1.0}, {j, i, -1.0}}) {
        stiffness(r, c) += sign * structure.stiffness(s);
        damping(r, c) += sign * structure.damping(s);
      }
    }
  damping.diagonal().array() += structure.body[0].friction;
  const double h = 0.01;
  const Eigen::MatrixX3d force = test::force_of(forces, state);
  const Eigen::VectorXd change =
      solved_without_pins(structure, mass_matrix(structure) + h * damping + h * h * stiffness,
                          h * flattened(force) - h * h * stiffness * flattened(state.velocity));
  for (const LinearSolver solver : {LinearSolver::conjugate_gradient, LinearSolver::cholesky}) {
    const State end = run(structure, Method::imex, {.linear_solver = solver, .tolerance = 1e-12}, state, h, 1);
    EXPECT_LT((flattened(end.velocity - state.velocity) - change).norm(), 1e-9 * change.norm());
  }
}

TEST(ImplicitSchemes, AgreeBetweenBothLinearSolvers) {
  const Structure structure = sheet();
  const State start = shaken_state(structure, 0.01, 1.0);
  for (const Method method : {Method::backward_euler, Method::imex}) {
    const State direct = run(structure, method, {.linear_solver = LinearSolver::cholesky}, start, 0.01, 100);
    const State iterative = run(structure, method, {.tolerance = 1e-12}, start, 0.01, 100);
    EXPECT_LT((direct.position - iterative.position).norm(), 1e-8 * direct.position.norm()) << name(method);
  }
}

TEST(ImplicitSchemes, CountTheirSolvesAndThoseThatCholeskyTookOver) {
  const Structure structure = sheet();
  const State start = shaken_state(structure, 0.02, 1.0);
  for (const Method method : {Method::backward_euler, Method::imex}) {
    SolveCounts counts;
    run(structure, method, {}, start, 0.01, 50, &counts);
    EXPECT_EQ(counts.solves, 50) << name(method);
    EXPECT_GE(counts.iterations, 20) << name(method);
    EXPECT_EQ(counts.by_cholesky, 0) << name(method);
    EXPECT_EQ(counts.failures, 0) << name(method);
    run(structure, method, {.tolerance = 1e-10, .max_iterations = 1}, start, 0.01, 50, &counts);
    EXPECT_EQ(counts.by_cholesky, 50) << name(method);
    EXPECT_EQ(counts.failures, 0) << name(method);
    EXPECT_EQ(counts.iterations, 50) << name(method);
    run(structure, method, {.linear_solver = LinearSolver::cholesky}, start, 0.01, 50, &counts);
    EXPECT_EQ(counts.solves, 50) << name(method);
    EXPECT_EQ(counts.by_cholesky, 0) << name(method);
    EXPECT_EQ(counts.failures, 0) << name(method);
  }
}

// 25 times FB Euler's limit, from a flat sheet that falls. IMEX slows the fall: the springs' linear part, taken
// implicitly, resists turning too, like relative damping of c = h k.
TEST(ImplicitSchemes, HangAStiffSheetWithStepsFarOverTheExplicitLimit) {
  for (const SpringModel model : {SpringModel::linear, SpringModel::choi_ko})
    for (const Method method : {Method::backward_euler, Method::imex})
      for (const LinearSolver solver : {LinearSolver::conjugate_gradient, LinearSolver::cholesky}) {
        SCOPED_TRACE(testing::Message() << name(method) << ", model " << static_cast<int>(model) << ", solver "
                                        << static_cast<int>(solver));
        Structure structure = grid({.width = 10, .height = 10, .spacing = 0.1, .mass = 0.002, .pinned = {0, 9}});
        scale_stiffness(structure, 1e6);
        structure.body[0].spring_model = model;
        structure.body[0].buckling_rigidity = 1e-6;
        SolveCounts counts;
        const State end = run(structure, method, {.linear_solver = solver}, rest_state(structure), 0.05, 200, &counts);
        EXPECT_EQ(counts.failures, 0);
        for (int s = 0; s < structure.springs(); ++s) {
          const double length =
              (end.position.row(structure.spring(s, 0)) - end.position.row(structure.spring(s, 1))).norm();
          ASSERT_LT(length, 1.2 * structure.rest_length(s)) << "spring " << s;
        }
        EXPECT_LT(end.position.col(1).minCoeff(), method == Method::imex ? -0.1 : -0.5) << "it must have fallen";
        EXPECT_GT(end.position.col(1).minCoeff(), -1.2) << "and not farther than it can reach";
      }
}

}  // namespace
}  // namespace billow::sim
