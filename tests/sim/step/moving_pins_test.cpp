// Pins that move are where their keys have them after every step, change nothing but the frame where they move evenly,
// and put in exactly the work that the motion gains.
#include "sim/step/moving_pins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "sim/body/momenta.h"
#include "sim/step/watched_run.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

const Eigen::Vector3d gravity{0.0, -9.81, 0.0};

std::vector<Method> methods() {
  std::vector<Method> list;
  for (const Scheme& scheme : schemes()) list.push_back(scheme.method);
  return list;
}

/// No filter, filters of velocities, and, for explicit methods, of forces.
std::vector<std::optional<FilterOptions>> filters(Method method) {
  std::vector<std::optional<FilterOptions>> list{std::nullopt};
  for (const FilterForm form : {FilterForm::plain, FilterForm::symmetric, FilterForm::conserving})
    list.push_back(FilterOptions{.form = form, .target = FilterTarget::velocity});
  if (!is_explicit(method)) return list;
  list.push_back(FilterOptions{.target = FilterTarget::force});
  list.push_back(FilterOptions{.kernel = FilterKernel::levels, .target = FilterTarget::force, .ratio = 3.0});
  return list;
}

Structure damped_cloth() {
  Structure structure = test::light_cloth(9, 8, {0, 1, 8});
  structure.damping.setConstant(0.02);
  return structure;
}

SolverOptions options_of(const Forces& forces, const std::vector<MovingPin>& pins, Method method, double step) {
  SolverOptions options{.method = method, .integrator = {.linear_solver = LinearSolver::cholesky}, .step = step};
  options.hooks.push_back([&forces, pins] { return std::make_unique<MovingPins>(forces.structure(), forces, pins); });
  return options;
}

KeyedMotion lifted_and_turned() {
  return {{{.time = 0.1},
           {.time = 0.3, .translation = {0.0, 0.2, 0.1}, .rotation = {0.0, 0.5, 0.0}},
           {.time = 0.6, .translation = {0.1, 0.2, 0.0}, .rotation = {0.3, 0.0, 1.0}}},
          {0.1, 0.0, 0.2}};
}

TEST(MovingPins, AreWhereTheirKeysHaveThemAfterEveryStepOfEveryScheme) {
  const Structure structure = damped_cloth();
  const Forces forces(structure, gravity);
  const KeyedMotion motion = lifted_and_turned();
  for (const Method method : methods())
    for (const auto& filter : filters(method)) {
      if (method == Method::forward_euler && !filter) continue;  // grows
      SolverOptions options = options_of(forces, {{{0, 1}, motion}}, method, 0.003);
      options.filter = filter;
      options.max_strain = torn_strain;
      Solver solver(structure, forces, options, rest_state(structure));
      for (int k = 1; k <= 250; ++k) {
        solver.advance();
        const State& state = solver.state();
        for (const int i : {0, 1}) {
          const Eigen::Vector3d rest = structure.rest_position.row(i), x = state.position.row(i),
                                v = state.velocity.row(i);
          ASSERT_LT((x - motion.at(state.time) * rest).norm(), 1e-14) << name(method) << " step " << k;
          ASSERT_LT((v - motion.velocity_at(state.time) * rest).norm(), 1e-12) << name(method) << " step " << k;
        }
        ASSERT_EQ(state.position.row(8), structure.rest_position.row(8)) << "held still";
        ASSERT_TRUE(state.velocity.row(8).isZero(0.0));
      }
    }
}

TEST(MovingPins, GoEvenlyDuringAStep) {
  const Structure structure = damped_cloth();
  const Forces forces(structure, gravity);
  const KeyedMotion motion = lifted_and_turned();
  MovingPins pins(structure, forces, {{{0, 1}, motion}});
  for (const double h : {0.02, 0.01, 0.005}) {
    State state = rest_state(structure);
    state.time = 0.2;
    const Eigen::Vector3d rest = structure.rest_position.row(1);
    state.position.row(1) = motion.at(0.2) * rest;
    pins.begin(state, h);
    const Eigen::Vector3d v = state.velocity.row(1), x = state.position.row(1);
    EXPECT_LT((x + h * v - motion.at(0.2 + h) * rest).norm(), 1e-15);
    EXPECT_LT((v - motion.velocity_at(0.2 + 0.5 * h) * rest).norm(), 20.0 * h * h) << "second order half-way";
  }
}

// With every pin at the same constant velocity the motion is that of a frame at rest, seen from another: springs, their
// damping, filters and every scheme depend on differences alone.
TEST(MovingPins, ThatMoveEvenlyChangeNothingButTheFrame) {
  const Structure structure = damped_cloth();
  const Forces forces(structure, gravity);
  const Eigen::Vector3d velocity{0.7, -0.4, 1.1};
  std::vector<PlaceKey> keys;
  for (int k = -2; k <= 4; ++k) keys.push_back({.time = 1.0 * k, .translation = velocity * k});
  const KeyedMotion even(keys, Eigen::Vector3d::Zero());
  const State at_rest = test::shaken_state(structure, 0.01, 0.5);
  State moving = at_rest;
  moving.velocity.rowwise() += velocity.transpose();
  for (const Method method : methods())
    for (const auto& filter : filters(method)) {
      if (method == Method::forward_euler && !filter) continue;  // grows
      SolverOptions options = options_of(forces, {{{0, 1}, even}, {{8}, even}}, method, 0.002);
      options.filter = filter;
      Solver moved(structure, forces, options, moving);
      options.hooks.clear();
      Solver still(structure, forces, options, at_rest);
      for (int k = 0; k < 150; ++k) moved.advance(), still.advance();
      const Eigen::Vector3d shift = velocity * still.state().time;
      const Eigen::MatrixX3d difference = moved.state().position.rowwise() - shift.transpose() - still.state().position;
      EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-12)
          << name(method) << " filter " << (filter ? static_cast<int>(filter->target) : -1);
    }
}

/// A mass that hangs by a spring from a pin, in balance at the start.
struct Pendant {
  double mass = 0.3, stiffness = 40.0, damping = 0.0;
  Structure structure() const {
    Structure s = test::oscillator(mass, stiffness);
    s.rest_position.row(1) << 0.0, -1.0, 0.0;
    s.damping.setConstant(damping);
    return s;
  }
  State balanced(const Structure& s) const {
    State state = rest_state(s);
    state.position(1, 1) -= mass * 9.81 / stiffness;
    return state;
  }
};

KeyedMotion lift(double begin, double end, double height) {
  return {{{.time = begin}, {.time = end, .translation = {0.0, height, 0.0}}}, Eigen::Vector3d::Zero()};
}

/// A pendant whose pin is lifted, stepped from where it hangs in balance.
struct LiftedPendant {
  LiftedPendant(const Pendant& pendant, const KeyedMotion& motion, Method method, double h)
      : structure(pendant.structure()),
        forces(structure, gravity),
        solver(structure, forces, options_of(forces, {{{0}, motion}}, method, h), pendant.balanced(structure)) {}

  /// Kinetic and potential, the work left out [J].
  double energy() const {
    return kinetic_energy(structure, solver.state()) + forces.potential_energy(solver.state()) - solver.work();
  }

  Structure structure;
  Forces forces;
  Solver solver;
};

/// The most that kinetic + potential - work strays from its start [J].
double imbalance(Method method, double h, double end) {
  LiftedPendant run(Pendant{}, lift(0.1, 0.7, 0.5), method, h);
  const double start = run.energy();
  double most = 0.0;
  while (run.solver.state().time < end - 0.5 * h) {
    run.solver.advance();
    most = std::max(most, std::abs(run.energy() - start));
  }
  return most;
}

// The mass then swings with about a joule; the lift itself takes twice that.
TEST(MovingPins, PutInTheWorkThatTheMotionGains) {
  for (const Method method : {Method::verlet, Method::rk4}) {
    EXPECT_LT(imbalance(method, 1e-3, 2.0), 3e-5) << name(method);
    EXPECT_NEAR(imbalance(method, 4e-3, 2.0) / imbalance(method, 2e-3, 2.0), 4.0, 0.4) << name(method);
  }
  EXPECT_LT(imbalance(Method::fb_euler, 1e-3, 2.0), 1e-2);
  EXPECT_NEAR(imbalance(Method::fb_euler, 1e-3, 2.0) / imbalance(Method::fb_euler, 5e-4, 2.0), 2.0, 0.2);
}

// Slowly, all the work is weight times height, the pin's own included.
TEST(MovingPins, WorkOfASlowLiftIsWeightTimesHeight) {
  LiftedPendant run(Pendant{.damping = 1.0}, lift(1.0, 61.0, 0.5), Method::verlet, 5e-3);
  run.solver.sample(70.0);
  const double weight = run.structure.mass.sum() * 9.81;
  EXPECT_NEAR(run.solver.work(), weight * 0.5, 1e-3 * weight * 0.5);
}

// Damping only takes: what it takes is not what the pins did.
TEST(MovingPins, LeaveDampingsLossAsALoss) {
  LiftedPendant run(Pendant{.damping = 0.5}, lift(0.1, 0.7, 0.5), Method::verlet, 5e-4);
  double before = HUGE_VAL;
  while (run.solver.state().time < 2.0) {
    run.solver.advance();
    EXPECT_LT(run.energy(), before + 1e-6) << run.solver.state().time;
    before = run.energy();
  }
}

/// Where the pendant is at `end` [s].
double height_at(Method method, double h, double end) {
  LiftedPendant run(Pendant{}, lift(0.25, 0.75, 0.5), method, h);
  while (run.solver.state().time < end - 0.5 * h) run.solver.advance();
  return run.solver.state().position(1, 1);
}

// A pin that goes evenly during a step is off by h^2 a / 8 within it at most.
TEST(MovingPins, LeaveVerletItsOrderAndGiveRungeKuttaTwo) {
  const double exact = height_at(Method::rk4, 1.0 / 8192.0, 1.0);
  for (const Method method : {Method::verlet, Method::rk4}) {
    const double coarse = std::abs(height_at(method, 1.0 / 64.0, 1.0) - exact);
    const double fine = std::abs(height_at(method, 1.0 / 256.0, 1.0) - exact);
    EXPECT_NEAR(coarse / fine, 16.0, 2.0) << name(method);
  }
}

/// A cloth that two pins lift by more than its height, watched.
std::vector<Incident> incidents_of(Method method, double step, bool accounted) {
  const Structure structure = damped_cloth();
  const Forces forces(structure, gravity);
  SolverOptions options = options_of(forces, {{{0, 1, 8}, lift(0.1, 1.1, 1.0)}}, method, step);
  if (!accounted)
    options.hooks[0] = [&forces] {
      class Forgetful : public MovingPins {
       public:
        using MovingPins::MovingPins;
        double work() const override { return 0.0; }
      };
      return std::make_unique<Forgetful>(forces.structure(), forces,
                                         std::vector<MovingPin>{{{0, 1, 8}, lift(0.1, 1.1, 1.0)}});
    };
  WatchedRun run(structure, forces, std::make_unique<Solver>(structure, forces, options, rest_state(structure)),
                 {.energy_scale = structure.mass.sum() * 9.81},
                 [k = 0]() mutable { return k < 60 ? 0.05 * k++ : HUGE_VAL; });
  while (run.next()) continue;
  return run.incidents();
}

TEST(MovingPins, AreNoCauseForTheWatchToStepIn) {
  EXPECT_FALSE(incidents_of(Method::fb_euler, 0.002, false).empty()) << "the test must be able to tell";
  EXPECT_TRUE(incidents_of(Method::fb_euler, 0.002, true).empty());
  EXPECT_TRUE(incidents_of(Method::verlet, 0.004, true).empty());
  EXPECT_TRUE(incidents_of(Method::backward_euler, 0.01, true).empty());
}

// Work is noted from step to step; a run that goes back must come to the same as one that does not.
TEST(MovingPins, GoBack) {
  const Structure structure = damped_cloth();
  const Forces forces(structure, gravity);
  const SolverOptions options = options_of(forces, {{{0, 1}, lifted_and_turned()}}, Method::fb_euler, 0.003);
  Solver straight(structure, forces, options, rest_state(structure));
  Solver back(structure, forces, options, rest_state(structure));
  for (int k = 0; k < 60; ++k) straight.advance(), back.advance();
  const Solver::Checkpoint checkpoint = back.checkpoint();
  for (int k = 0; k < 60; ++k) straight.advance(), back.advance();
  back.go_back(checkpoint);
  for (int k = 0; k < 60; ++k) back.advance();
  EXPECT_EQ(straight.state().position, back.state().position);
  EXPECT_EQ(straight.state().velocity, back.state().velocity);
  EXPECT_EQ(straight.work(), back.work());
}

TEST(MovingPins, MovePinnedParticlesOnly) {
  const Structure structure = damped_cloth();
  const Forces forces(structure, gravity);
  EXPECT_THROW(MovingPins(structure, forces, {{{2}, lift(0.0, 1.0, 1.0)}}), InputError);
  EXPECT_THROW(MovingPins(structure, forces, {{{-1}, lift(0.0, 1.0, 1.0)}}), InputError);
}

}  // namespace
}  // namespace billow::sim
