// A pin that lets go leaves a run that cannot be told from one that starts there without it.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/body/momenta.h"
#include "sim/step/moving_pins.h"
#include "sim/step/watched_run.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

const Eigen::Vector3d gravity{0.0, -9.81, 0.0};
constexpr double h = 1.0 / 256.0;  // times are exact

Structure freed(Structure structure, const std::vector<int>& particles) {
  for (const int i : particles) structure.inverse_mass(i) = 1.0 / structure.mass(i);
  return structure;
}

/// A cloth held by three pins, of which the first two let go at `time`.
struct Scene {
  Structure held = test::light_cloth(9, 8, {0, 1, 8}), loose = freed(held, {0, 1});
  Forces held_forces{held, gravity}, loose_forces{loose, gravity};
  double time = 0.25;

  SolverOptions loose_options(Method method, const std::optional<FilterOptions>& filter) const {
    return {.method = method, .integrator = {.linear_solver = LinearSolver::cholesky}, .filter = filter, .step = h};
  }
  SolverOptions options(Method method, const std::optional<FilterOptions>& filter) const {
    SolverOptions options = loose_options(method, filter);
    options.releases = {{.time = time, .structure = &loose, .forces = &loose_forces, .filter = filter}};
    return options;
  }
  Solver solver(Method method = Method::fb_euler, const std::optional<FilterOptions>& filter = {}) const {
    return {held, held_forces, options(method, filter), test::shaken_state(held, 0.005, 0.3)};
  }
};

void expect_same(const State& one, const State& other) {
  EXPECT_EQ(one.position, other.position);
  EXPECT_EQ(one.velocity, other.velocity);
  EXPECT_EQ(one.time, other.time);
}

TEST(Release, LetsAMassFall) {
  const Structure held = test::oscillator(0.3, 0.0), loose = freed(held, {0});
  const Forces held_forces(held, gravity), loose_forces(loose, gravity);
  for (const Method method : {Method::verlet, Method::rk4}) {
    SolverOptions options{.method = method, .step = h};
    options.releases = {{.time = 0.5, .structure = &loose, .forces = &loose_forces}};
    Solver solver(held, held_forces, options, rest_state(held));
    while (solver.state().time < 2.0) {
      solver.advance();
      const double falling = std::max(solver.state().time - 0.5, 0.0);
      EXPECT_NEAR(solver.state().position(0, 1), -0.5 * 9.81 * falling * falling, 1e-12) << solver.state().time;
      EXPECT_NEAR(solver.state().velocity(0, 1), -9.81 * falling, 1e-12);
    }
  }
}

// What was moved flies on at the velocity that it had.
TEST(Release, ThrowsAMassThatWasMoved) {
  const Structure held = test::oscillator(0.3, 0.0), loose = freed(held, {0});
  const Forces held_forces(held, gravity), loose_forces(loose, gravity);
  const KeyedMotion swing({{.time = 0.0}, {.time = 1.0, .translation = {2.0, 1.0, 0.0}}}, Eigen::Vector3d::Zero());
  SolverOptions options{.method = Method::verlet, .step = h};
  options.hooks = {[&] {
    return std::make_unique<MovingPins>(held, held_forces, std::vector<MovingPin>{{{0}, swing}});
  }};
  options.releases = {{.time = 0.5, .structure = &loose, .forces = &loose_forces}};
  Solver solver(held, held_forces, options, rest_state(held));
  while (solver.state().time < 0.875) solver.advance();
  const Eigen::Vector3d x = solver.state().position.row(0), v = swing.velocity_at(0.5) * Eigen::Vector3d::Zero();
  const double flown = 0.375;
  EXPECT_GT(v.norm(), 3.0);
  EXPECT_LT((x - (swing.at(0.5) * Eigen::Vector3d::Zero() + flown * v + 0.5 * flown * flown * gravity)).norm(), 1e-12);
}

TEST(Release, ContinuesLikeARunThatStartsThereWithoutThePin) {
  const std::vector<std::optional<FilterOptions>> filters{
      std::nullopt, FilterOptions{}, FilterOptions{.form = FilterForm::conserving},
      FilterOptions{.target = FilterTarget::force, .distances = FilterDistances::current},
      FilterOptions{.kernel = FilterKernel::levels, .target = FilterTarget::force, .ratio = 3.0}};
  const Scene scene;
  for (const Method method : {Method::fb_euler, Method::verlet, Method::rk4, Method::backward_euler, Method::imex})
    for (const auto& filter : filters) {
      if (filter && filter->target == FilterTarget::force && !is_explicit(method)) continue;
      SCOPED_TRACE(testing::Message() << name(method) << (filter ? ", filter of " : ", no filter")
                                      << (filter ? name(filter->target) : ""));
      Solver solver = scene.solver(method, filter);
      while (solver.state().time < scene.time) solver.advance();
      Solver from_there(scene.loose, scene.loose_forces, scene.loose_options(method, filter), solver.state());
      for (int k = 0; k < 50; ++k) solver.advance(), from_there.advance();
      expect_same(solver.state(), from_there.state());
      EXPECT_GT((solver.state().position - scene.held.rest_position).row(0).norm(), 0.01) << "it has let go";
      EXPECT_TRUE((solver.state().position - scene.held.rest_position).row(8).isZero(0.0)) << "this one holds";
    }
}

// The first step that ends then or later is the last before it.
TEST(Release, HoldsThroughTheStepItFallsInto) {
  Scene scene;
  scene.time = 10.4 * h;
  Solver solver = scene.solver();
  for (int k = 1; k <= 11; ++k) {
    solver.advance();
    EXPECT_EQ(solver.state().position.row(0), scene.held.rest_position.row(0)) << k;
  }
  solver.advance();
  EXPECT_NE(solver.state().position.row(0), scene.held.rest_position.row(0));
}

TEST(Release, IsGoneBackAcross) {
  const Scene scene;
  const FilterOptions filter{.form = FilterForm::conserving};
  Solver straight = scene.solver(Method::fb_euler, filter), back = scene.solver(Method::fb_euler, filter);
  for (int k = 0; k < 60; ++k) straight.advance(), back.advance();
  const Solver::Checkpoint checkpoint = back.checkpoint();
  ASSERT_LT(back.state().time, scene.time);
  for (int k = 0; k < 40; ++k) straight.advance(), back.advance();
  back.go_back(checkpoint);
  for (int k = 0; k < 40; ++k) back.advance();
  expect_same(straight.state(), back.state());
}

TEST(Release, MayBeFollowedByOthers) {
  const Scene scene;
  const Structure all = freed(scene.loose, {8});
  const Forces all_forces(all, gravity);
  SolverOptions options = scene.options(Method::fb_euler, {});
  options.releases.push_back({.time = 0.5, .structure = &all, .forces = &all_forces});
  Solver solver(scene.held, scene.held_forces, options, rest_state(scene.held));
  while (solver.state().time < 0.5) solver.advance();
  EXPECT_EQ(solver.state().position.row(8), scene.held.rest_position.row(8));
  const Eigen::Vector3d before = linear_momentum(all, solver.state());
  for (int k = 0; k < 64; ++k) solver.advance();
  EXPECT_LT((linear_momentum(all, solver.state()) - before - 0.25 * all.mass.sum() * gravity).norm(), 1e-12)
      << "nothing holds it any more";
}

// The cloth swings down from where it was held: its energy stays in balance, and no step is taken back.
TEST(Release, LeavesTheWatchAtRest) {
  const Scene scene;
  const auto run = [&](int stretch) {
    return WatchedRun(scene.held, scene.held_forces, std::make_unique<Solver>(scene.solver()),
                      {.energy_scale = scene.held.mass.sum() * 9.81, .stretch = stretch},
                      [k = 0]() mutable { return k < 30 ? 0.05 * k++ : HUGE_VAL; });
  };
  WatchedRun one = run(16), other = run(7);
  Solver plain = scene.solver();
  for (auto sample = one.next(); sample; sample = one.next()) {
    expect_same(sample->state, other.next()->state);
    expect_same(sample->state, plain.sample(sample->time));
  }
  EXPECT_TRUE(one.incidents().empty());
}

TEST(Release, KeepsCountOfLinearSolves) {
  const Scene scene;
  Solver solver = scene.solver(Method::backward_euler);
  for (int k = 0; k < 100; ++k) solver.advance();
  EXPECT_EQ(solver.solve_counts().solves, 100);
}

}  // namespace
}  // namespace billow::sim
