// The stations of a step in their order: when forces and filter look at the clock, what hooks see and what then moves.
#include "sim/step/step.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/evaluations.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::grid;
using test::shaken_state;

constexpr IntegratorOptions exact_solver = {.linear_solver = LinearSolver::cholesky};
constexpr double h = 0.01;

Structure sheet() {
  return grid({.width = 4, .height = 3, .spacing = 0.1, .mass = 0.02, .structural = 20.0, .pinned = {0}});
}

State started(const Structure& structure) {
  State state = shaken_state(structure, 0.01, 1.0);
  state.time = 0.5;
  return state;
}

std::vector<Method> methods() {
  std::vector<Method> list;
  for (const Scheme& scheme : schemes()) list.push_back(scheme.method);
  return list;
}

/// Leaves velocities alone.
class Idle : public StepHook {
 public:
  void apply(const State&, const Move&, Eigen::MatrixX3d&) override {}
};

// lambda falls to a fifth over a second: the filter of the step's end would be another.
FilterOptions fading(FilterTarget target) { return {.target = target, .lambda_keys = {{0.5, 1.0}, {0.6, 0.2}}}; }

State stepped(const Forces& forces, Method method, const Filter* filter, State state, bool hooked = false) {
  Step step(forces, method, exact_solver, filter);
  if (hooked) step.add(std::make_unique<Idle>());
  step(state, h);
  return state;
}

// In one pass with the move and, where a hook comes between them, not.
TEST(Step, FiltersVelocitiesWithTheLambdaOfItsBeginning) {
  const Structure structure = sheet();
  const Forces forces(structure, {0.0, -9.81, 0.0});
  const Filter filter(structure, fading(FilterTarget::velocity));
  const State start = started(structure);
  for (const Method method : methods())
    for (const bool hooked : {false, true}) {
      SCOPED_TRACE(testing::Message() << name(method) << (hooked ? ", hooked" : ""));
      Eigen::MatrixX3d expected = stepped(forces, method, nullptr, start).velocity, later = expected;
      test::apply(filter, start.position, start.time, expected);
      test::apply(filter, start.position, start.time + h, later);
      const State end = stepped(forces, method, &filter, start, hooked);
      EXPECT_LT((end.velocity - expected).norm(), 1e-12 * expected.norm());
      EXPECT_GT((end.velocity - later).norm(), 1e-3 * expected.norm()) << "the test must be able to tell";
    }
}

// Accelerations are filtered as soon as they are known: at the time at which the forces were taken.
TEST(Step, FiltersForcesWithTheLambdaOfTheirOwnTime) {
  const Structure structure = sheet();
  const Forces forces(structure, {0.0, -9.81, 0.0});
  const Filter filter(structure, fading(FilterTarget::force));
  const State start = started(structure);
  for (const auto& [method, share] :
       {std::pair{Method::forward_euler, 0.0}, {Method::fb_euler, 0.0}, {Method::verlet, 0.5}}) {
    State seen = start;
    move(seen, share * h);
    Eigen::MatrixX3d acceleration = test::acceleration_of(forces, seen);
    test::apply(filter, seen.position, start.time + share * h, acceleration);
    const Eigen::MatrixX3d expected = start.velocity + h * acceleration;
    EXPECT_LT((stepped(forces, method, &filter, start).velocity - expected).norm(), 1e-12 * expected.norm())
        << name(method);
  }
}

TEST(Step, EndsAtItsBeginningPlusH) {
  const Structure structure = sheet();
  const Forces forces(structure, Eigen::Vector3d::Zero());
  for (const Method method : methods())
    EXPECT_EQ(stepped(forces, method, nullptr, started(structure)).time, 0.5 + h) << name(method);
}

/// f = m a(t) along x, whatever the state.
class Drive : public ForceLaw {
 public:
  Drive(const Structure& structure, std::function<double(double)> acceleration)
      : structure_(structure), acceleration_(std::move(acceleration)) {}
  std::string_view name() const override { return "the drive"; }
  void add_force(const State& state, Eigen::MatrixX3d& force) const override {
    force.col(0) += acceleration_(state.time) * structure_.mass;
  }
  double energy(const State&) const override { return 0.0; }
  void add_linearisation(const State&, double, double, JacobianForm, StiffnessMatrix&) const override {}
  bool add_bound(Shapes, Linearisation&) const override { return true; }
  void add_least_damping(StiffnessMatrix&) const override {}
  bool passive() const override { return false; }
  double work(const State&, const State&) const override { return 0.0; }
  bool join(FusedSweep&) const override { return false; }

 private:
  const Structure& structure_;
  std::function<double(double)> acceleration_;
};

/// What a step of `length` [s] from rest at 0.5 s makes of a particle under a(t): x [m] and v [m/s].
Eigen::Vector2d driven(Method method, const std::function<double(double)>& acceleration, double length) {
  const Structure structure = grid({.width = 2, .height = 2, .structural = 0.0, .shear = 0.0, .bend = 0.0});
  Forces forces(structure);
  forces.add(std::make_unique<Drive>(structure, acceleration));
  State state = rest_state(structure);
  state.time = 0.5;
  Step(forces, method, {}, nullptr)(state, length);
  return {state.position(0, 0) - structure.rest_position(0, 0), state.velocity(0, 0)};
}

// With forces that know nothing but the time, v' = v + h/6 (a(t) + 4 a(t + h/2) + a(t + h)) is Simpson's rule, exact to
// the third degree, and x' = x + h v + h^2/6 (a(t) + 2 a(t + h/2)) is exact to the second.
TEST(RungeKutta4, IntegratesAForceThatVariesWithTimeBySimpsonsRule) {
  const auto cube = [](double t) { return t * t * t; };
  const auto square = [](double t) { return t * t; };
  constexpr double start = 0.5, end = 1.2, length = end - start;
  const double fourth = std::pow(end, 4) - std::pow(start, 4);
  EXPECT_NEAR(driven(Method::rk4, cube, length)(1), fourth / 4.0, 1e-14);
  EXPECT_NEAR(driven(Method::rk4, square, length)(0), fourth / 12.0 - length * std::pow(start, 3) / 3.0, 1e-14);
}

TEST(EveryExplicitScheme, TakesForcesAtItsOwnMoments) {
  const auto square = [](double t) { return t * t; };
  EXPECT_DOUBLE_EQ(driven(Method::forward_euler, square, 0.2)(1), 0.2 * square(0.5));
  EXPECT_DOUBLE_EQ(driven(Method::fb_euler, square, 0.2)(1), 0.2 * square(0.5));
  EXPECT_DOUBLE_EQ(driven(Method::verlet, square, 0.2)(1), 0.2 * square(0.6)) << "half-way";
}

/// Writes down what it sees, then makes velocities `factor` times as large.
class Scaling : public StepHook {
 public:
  struct Seen {
    State state;
    Move move;
    Eigen::MatrixX3d velocity;
  };
  Scaling(double factor, std::vector<Seen>& seen) : factor_(factor), seen_(seen) {}
  void apply(const State& state, const Move& move, Eigen::MatrixX3d& velocity) override {
    seen_.push_back({state, move, velocity});
    velocity *= factor_;
  }

 private:
  double factor_;
  std::vector<Seen>& seen_;
};

// forces -> integrate -> filter -> hooks, in their order -> move.
TEST(Step, ShowsFilteredVelocitiesToItsHooksAndMovesByWhatTheyLeave) {
  const Structure structure = sheet();
  const Forces forces(structure, {0.0, -9.81, 0.0});
  const Filter filter(structure, {});
  const State start = started(structure), unhooked = stepped(forces, Method::fb_euler, &filter, start);
  std::vector<Scaling::Seen> seen;
  Step step(forces, Method::fb_euler, {}, &filter);
  step.add(std::make_unique<Scaling>(0.5, seen));
  step.add(std::make_unique<Scaling>(3.0, seen));
  State state = start;
  step(state, h);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].velocity, unhooked.velocity);
  EXPECT_EQ(seen[1].velocity, 0.5 * unhooked.velocity);
  EXPECT_EQ(seen[0].state.position, start.position);
  EXPECT_EQ(seen[0].state.velocity, start.velocity);
  EXPECT_EQ(seen[0].move.by_new, h);
  EXPECT_EQ(state.velocity, 3.0 * (0.5 * unhooked.velocity));
  EXPECT_EQ(state.position, start.position + h * state.velocity);
}

// x' = x + h v: neither filter nor hook reaches this step's move, only the next one's.
TEST(ForwardEuler, MovesByTheVelocitiesOfItsBeginning) {
  const Structure structure = sheet();
  const Forces forces(structure, {0.0, -9.81, 0.0});
  const Filter filter(structure, {});
  const State start = started(structure);
  for (const Filter* f : {static_cast<const Filter*>(nullptr), &filter})
    for (const bool hooked : {false, true})
      EXPECT_EQ(stepped(forces, Method::forward_euler, f, start, hooked).position, start.position + h * start.velocity);
}

// What the one pass over memory comes to is what its stations come to one by one.
TEST(Step, IsTheSameWithAHookThatDoesNothing) {
  const Structure structure = sheet();
  const Forces forces(structure, {0.0, -9.81, 0.0});
  for (const FilterForm form : {FilterForm::plain, FilterForm::conserving}) {
    const Filter filter(structure, {.form = form});
    for (const Method method : methods()) {
      const State plain = stepped(forces, method, &filter, started(structure));
      const State hooked = stepped(forces, method, &filter, started(structure), true);
      EXPECT_EQ(plain.position, hooked.position) << name(method);
      EXPECT_EQ(plain.velocity, hooked.velocity) << name(method);
    }
  }
}

}  // namespace
}  // namespace billow::sim
