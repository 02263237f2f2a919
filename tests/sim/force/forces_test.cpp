// Forces against what physics says of them: gradients of energies, conserved momenta, symmetries, what damps what.
#include "sim/force/forces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

#include "base/random.h"
#include "sim/body/momenta.h"
#include "sim/step/step.h"
#include "tests/support/evaluations.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::grid;
using test::ring;
using test::shaken_state;
using test::with_uneven_masses;

Structure sheet(SpringModel model) {
  Structure structure =
      grid({.width = 5, .height = 4, .spacing = 0.1, .structural = 100.0, .shear = 70.0, .bend = 30.0});
  structure.body[0].spring_model = model;
  structure.body[0].buckling_rigidity = 1e-4;
  return with_uneven_masses(structure, 0.5);
}

Eigen::MatrixX3d force_of(const Structure& structure, const State& state, const Eigen::Vector3d& gravity) {
  return test::force_of(Forces(structure, gravity), state);
}

Eigen::MatrixX3d force_of(const Structure& structure, const State& state) {
  return force_of(structure, state, Eigen::Vector3d::Zero());
}

Eigen::MatrixX3d minus_energy_gradient(const Forces& forces, const State& state, double d) {
  return test::minus_gradient([&](const State& at) { return forces.potential_energy(at); }, state, d);
}

TEST(Forces, AreMinusTheGradientOfTheEnergy) {
  for (const SpringModel model : {SpringModel::linear, SpringModel::choi_ko})
    for (const double distance : {0.001, 0.02, 0.06})
      for (const double g : {0.0, 9.81}) {
        SCOPED_TRACE(testing::Message() << static_cast<int>(model) << ", shaken by " << distance << " m, g = " << g);
        const Structure structure = sheet(model);
        const State state = shaken_state(structure, distance, 0.0, 3);
        const Forces forces(structure, {0.3 * g, -g, 0.1 * g});
        const Eigen::MatrixX3d force = test::force_of(forces, state);
        EXPECT_LT((force - minus_energy_gradient(forces, state, 3e-7)).norm(), 1e-6 * force.norm());
      }
}

TEST(Forces, OfSpringsVanishAtRestAndGravityIsWeight) {
  const Structure structure = sheet(SpringModel::linear);
  EXPECT_LT(force_of(structure, rest_state(structure)).norm(), 1e-12);
  const Eigen::MatrixX3d weight = force_of(structure, rest_state(structure), {0.0, -9.81, 0.0});
  EXPECT_LT((weight.col(1) + 9.81 * structure.mass).norm(), 1e-12);
}

TEST(Forces, OfOneSpringAreHookesLaw) {
  const Structure structure = test::oscillator(1.0, 50.0, 2.0);
  State state = rest_state(structure);
  state.position.row(1) << 0.0, 3.0, 4.0;  // 5 m long, stretched by 3 m
  const Eigen::MatrixX3d force = force_of(structure, state);
  EXPECT_LT((force.row(0) - Eigen::RowVector3d(0.0, 90.0, 120.0)).norm(), 1e-12);
  EXPECT_LT((force.row(1) + Eigen::RowVector3d(0.0, 90.0, 120.0)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(Forces(structure, Eigen::Vector3d::Zero()).potential_energy(state), 225.0);
}

TEST(Forces, AreFiniteWhenTwoParticlesCoincide) {
  for (const SpringModel model : {SpringModel::linear, SpringModel::choi_ko}) {
    Structure structure = sheet(model);
    structure.damping.setConstant(0.1);
    State state = shaken_state(structure, 0.01, 1.0);
    state.position.row(1) = state.position.row(0);
    EXPECT_TRUE(force_of(structure, state).allFinite());
    EXPECT_TRUE(std::isfinite(Forces(structure, Eigen::Vector3d::Zero()).potential_energy(state)));
  }
}

struct Scheme {
  Method method;
  IntegratorOptions options = {};
};

// The direct solver: conjugate gradients conserve momentum only to their tolerance.
const std::vector<Scheme>& schemes() {
  static const std::vector<Scheme> list = {{Method::forward_euler},
                                           {Method::fb_euler},
                                           {Method::verlet},
                                           {Method::rk4},
                                           {Method::backward_euler, {.linear_solver = LinearSolver::cholesky}},
                                           {Method::imex, {.linear_solver = LinearSolver::cholesky}}};
  return list;
}

State run(const Structure& structure, const Scheme& scheme, State state, double h, int steps) {
  const Forces forces(structure, Eigen::Vector3d::Zero());
  Step step(forces, scheme.method, scheme.options, nullptr);
  for (int k = 0; k < steps; ++k) step(state, h);
  return state;
}

double momentum_scale(const Structure& structure, const State& state) {
  return structure.mass.dot(state.velocity.rowwise().norm());
}

TEST(FreeBody, KeepsItsLinearMomentumToRoundingInEveryScheme) {
  for (const DampingModel damping : {DampingModel::projected, DampingModel::spring})
    for (const Scheme& scheme : schemes()) {
      SCOPED_TRACE(testing::Message() << name(scheme.method) << ", damping " << static_cast<int>(damping));
      Structure structure = sheet(SpringModel::linear);
      structure.damping.setConstant(0.5);
      structure.body[0].damping_model = damping;
      const State start = shaken_state(structure, 0.01, 1.0);
      const State end = run(structure, scheme, start, 0.005, 500);
      EXPECT_LT((linear_momentum(structure, end) - linear_momentum(structure, start)).norm(),
                1e-12 * momentum_scale(structure, start));
    }
}

// v' = v + h a(x), x' = x + h v': L' = sum m (x + h v') x v' = sum m x x v' = L + h sum x x f = L.
TEST(FreeBody, KeepsItsAngularMomentumToRoundingInTheSymplecticSchemes) {
  for (const Method method : {Method::fb_euler, Method::verlet}) {
    SCOPED_TRACE(name(method));
    Structure structure = sheet(SpringModel::choi_ko);
    structure.damping.setConstant(0.5);
    const State start = shaken_state(structure, 0.01, 1.0);
    const State end = run(structure, {method}, start, 0.005, 1000);
    EXPECT_LT((angular_momentum(structure, end) - angular_momentum(structure, start)).norm(),
              1e-11 * momentum_scale(structure, start));
  }
}

TEST(Forces, TurnWithTheBodyAndIgnoreWhereItIs) {
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).matrix();
  for (const SpringModel model : {SpringModel::linear, SpringModel::choi_ko})
    for (const DampingModel damping : {DampingModel::projected, DampingModel::spring}) {
      Structure structure = sheet(model);
      structure.damping.setConstant(0.5);
      structure.body[0].damping_model = damping;
      structure.body[0].friction = 0.2;
      const State state = shaken_state(structure, 0.03, 1.0);
      State moved = state;
      moved.position = (state.position * rotation.transpose()).rowwise() + Eigen::RowVector3d(3.0, -1.0, 2.0);
      moved.velocity = state.velocity * rotation.transpose();
      const Eigen::MatrixX3d expected = force_of(structure, state) * rotation.transpose();
      EXPECT_LT((force_of(structure, moved) - expected).norm(), 1e-12 * expected.norm());
      EXPECT_NEAR(Forces(structure, Eigen::Vector3d::Zero()).potential_energy(moved),
                  Forces(structure, Eigen::Vector3d::Zero()).potential_energy(state), 1e-12);
    }
}

Structure renumbered(Structure structure, const Eigen::PermutationMatrix<Eigen::Dynamic>& order) {
  structure.rest_position = (order * structure.rest_position).eval();
  structure.mass = (order * structure.mass).eval();
  structure.inverse_mass = (order * structure.inverse_mass).eval();
  for (int s = 0; s < structure.springs(); ++s) {
    const auto [low, high] =
        std::minmax(order.indices()(structure.spring(s, 0)), order.indices()(structure.spring(s, 1)));
    structure.spring.row(s) << low, high;
  }
  return structure;
}

TEST(Forces, DoNotDependOnHowParticlesAreNumbered) {
  Structure structure = sheet(SpringModel::choi_ko);
  structure.damping.setConstant(0.1);
  Eigen::PermutationMatrix<Eigen::Dynamic> order(structure.particles());
  for (int i = 0; i < structure.particles(); ++i) order.indices()(i) = (7 * i + 3) % structure.particles();
  const Structure other = renumbered(structure, order);
  const State state = shaken_state(structure, 0.02, 1.0);
  const State same = {order * state.position, order * state.velocity, 0.0};
  const State end = run(structure, {Method::fb_euler}, state, 0.002, 300);
  const State other_end = run(other, {Method::fb_euler}, same, 0.002, 300);
  EXPECT_LT((order * end.position - other_end.position).norm(), 1e-9 * end.position.norm());
}

// Velocities of a rigid rotation: spring lengths do not change.
State rotating(const Structure& structure, State state, const Eigen::Vector3d& spin) {
  for (int i = 0; i < structure.particles(); ++i)
    state.velocity.row(i) = spin.cross(Eigen::Vector3d(state.position.row(i))).transpose();
  return state;
}

TEST(Damping, ActsOnARigidRotationUnlessItIsProjected) {
  for (const bool fluid : {false, true})
    for (const DampingModel model : {DampingModel::projected, DampingModel::spring}) {
      Structure structure = sheet(SpringModel::linear);
      const State state = rotating(structure, shaken_state(structure, 0.02, 0.0), {0.5, 3.0, -1.0});
      const Eigen::MatrixX3d elastic = force_of(structure, state);
      if (fluid)
        structure.body[0].friction = 0.3;
      else
        structure.damping.setConstant(0.3);
      structure.body[0].damping_model = model;
      const Eigen::MatrixX3d damping = force_of(structure, state) - elastic;
      const double power = damping.cwiseProduct(state.velocity).sum();
      double expected = fluid ? -0.3 * state.velocity.squaredNorm() : 0.0;
      if (!fluid && model == DampingModel::spring)
        for (int s = 0; s < structure.springs(); ++s)
          expected -=
              0.3 *
              (state.velocity.row(structure.spring(s, 1)) - state.velocity.row(structure.spring(s, 0))).squaredNorm();
      EXPECT_NEAR(power, expected, 1e-12 * state.velocity.squaredNorm());
      EXPECT_EQ(damping.norm() < 1e-12, expected == 0.0);
    }
}

TEST(Damping, ProjectedKeepsARingSpinningAndRelativeStopsIt) {
  for (const DampingModel model : {DampingModel::projected, DampingModel::spring}) {
    Structure structure = ring(12, 0.1, 500.0);
    structure.damping.setConstant(0.1);
    structure.body[0].damping_model = model;
    const State start = rotating(structure, rest_state(structure), {0.0, 5.0, 0.0});
    const State end = run(structure, {Method::fb_euler}, start, 0.005, 2000);
    const double kept = angular_momentum(structure, end).y() / angular_momentum(structure, start).y();
    EXPECT_NEAR(kept, model == DampingModel::projected ? 1.0 : 0.0, model == DampingModel::projected ? 1e-11 : 0.2);
  }
}

// v' = v + h (a - (c/m) v) takes the same share of the angular momentum at every step.
TEST(Damping, FrictionStopsARingAtItsOwnRate) {
  Structure structure = ring(12, 0.1, 500.0);
  structure.body[0].friction = 0.02;
  const State start = rotating(structure, rest_state(structure), {0.0, 5.0, 0.0});
  const State end = run(structure, {Method::fb_euler}, start, 0.005, 1000);
  const double expected = std::pow(1.0 - 0.005 * 0.02 / 0.1, 1000) * angular_momentum(structure, start).y();
  EXPECT_NEAR(angular_momentum(structure, end).y(), expected, 1e-11 * expected);
}

// A body that moves as one under friction c per particle: v = v0 e^(-c t / m), x = x0 + v0 (m / c) (1 - e^(-c t / m)).
TEST(Damping, FrictionSlowsAFreeBodyExponentially) {
  Structure structure = grid({.width = 3, .height = 3, .mass = 0.2});
  structure.body[0].friction = 0.1;
  State start = rest_state(structure);
  const Eigen::RowVector3d velocity(1.0, -2.0, 0.5);
  start.velocity.rowwise() = velocity;
  const State end = run(structure, {Method::rk4}, start, 0.01, 300);
  const double left = std::exp(-0.1 / 0.2 * 3.0);
  EXPECT_LT((end.velocity.rowwise() - left * velocity).norm(), 1e-10);
  EXPECT_LT(((end.position - start.position).rowwise() - (1.0 - left) * 2.0 * velocity).norm(), 1e-10);
}

TEST(Damping, NeverAddsEnergy) {
  for (const DampingModel model : {DampingModel::projected, DampingModel::spring})
    for (int seed = 0; seed < 20; ++seed) {
      Structure structure = sheet(SpringModel::linear);
      const State state = shaken_state(structure, 0.05, 1.0, 2 * seed);
      const Eigen::MatrixX3d elastic = force_of(structure, state);
      structure.damping = Eigen::VectorXd::LinSpaced(structure.springs(), 0.0, 1.0);
      structure.body[0].damping_model = model;
      EXPECT_LT((force_of(structure, state) - elastic).cwiseProduct(state.velocity).sum(), 0.0);
    }
}

TEST(Bodies, MoveAsIfEachWereAlone) {
  Structure first = sheet(SpringModel::linear), second = ring(9, 0.1, 200.0, 0.2);
  second.damping.setConstant(0.05);
  second.body[0].friction = 0.1;
  second.body[0].damping_model = DampingModel::spring;
  const Structure both = merge({first, second});
  const State a = shaken_state(first, 0.02, 1.0, 1), b = shaken_state(second, 0.02, 1.0, 5);
  State together{Eigen::MatrixX3d(both.particles(), 3), Eigen::MatrixX3d(both.particles(), 3), 0.0};
  together.position << a.position, b.position;
  together.velocity << a.velocity, b.velocity;
  for (const Method method : {Method::forward_euler, Method::fb_euler, Method::verlet, Method::rk4}) {
    const State end = run(both, {method}, together, 0.002, 100);
    EXPECT_EQ(end.position.topRows(first.particles()), run(first, {method}, a, 0.002, 100).position);
    EXPECT_EQ(end.position.bottomRows(second.particles()), run(second, {method}, b, 0.002, 100).position);
  }
}

TEST(Bodies, OfAMergedStructureKeepTheirRanges) {
  const Structure a = ring(5, 1.0, 1.0), b = grid({.width = 3, .height = 2});
  const Structure whole = merge({a, b, a});
  ASSERT_EQ(whole.body.size(), 3u);
  EXPECT_EQ(whole.particles(), 5 + 6 + 5);
  EXPECT_EQ(whole.springs(), 2 * a.springs() + b.springs());
  EXPECT_EQ(whole.body[1].first_particle, 5);
  EXPECT_EQ(whole.body[2].first_particle, 11);
  EXPECT_EQ(whole.body[2].first_spring, a.springs() + b.springs());
  for (const Body& body : whole.body)
    for (int s = body.first_spring; s < body.first_spring + body.springs; ++s)
      for (int end = 0; end < 2; ++end) {
        EXPECT_GE(whole.spring(s, end), body.first_particle);
        EXPECT_LT(whole.spring(s, end), body.first_particle + body.particles);
      }
}

}  // namespace
}  // namespace billow::sim
