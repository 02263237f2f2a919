// The watch: nothing changes where all is well; energy that climbs and springs that fly apart are gone back from; and
// what no step mends is said.
#include "sim/step/watched_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "sim/body/momenta.h"
#include "tests/support/structures.h"
#include "tests/support/swimmers.h"

namespace billow::sim {
namespace {

using testing::HasSubstr;
using testing::Not;

/// 0, 1/fps, 2/fps, ... before `end`; those after `begin` where it is no longer 0.
WatchedRun::NextTime every(double interval, double end, double begin = 0.0) {
  return [interval, end, begin, k = 0L]() mutable {
    double time = static_cast<double>(k++) * interval;
    while (begin > 0.0 && time <= begin) time = static_cast<double>(k++) * interval;
    return time < end - 1e-9 ? time : HUGE_VAL;
  };
}

struct Scene {
  Structure structure = test::light_cloth(6, 6, {0});
  Eigen::Vector3d gravity{0.0, -9.81, 0.0}, velocity = Eigen::Vector3d::Zero();
  Method method = Method::fb_euler;
  double step = 0.004, begin = 0.0, end = 2.0, interval = 0.02;
  bool changes_step = true;

  State start() const {
    State state = rest_state(structure);
    state.velocity.rowwise() = velocity.transpose();
    return state;
  }
  double scale() const {
    return std::max(structure.mass.sum() * gravity.norm() * 0.7, 0.5 * structure.mass.sum() * velocity.squaredNorm());
  }
};

/// A run to its end, or to where it gave up.
struct Outcome {
  std::vector<WatchedRun::Sample> samples;
  std::vector<Incident> incidents;
  std::vector<double> energy;
  long steps = 0;
  SolveCounts solves;
  int halvings_at_the_end = 0;
  std::string divergence;

  double climb() const {
    double lowest = HUGE_VAL, most = 0.0;
    for (const double e : energy) lowest = std::min(lowest, e), most = std::max(most, e - lowest);
    return most;
  }
};

using Preparation = std::function<void(WatchedRun&)>;

Outcome run(
    const Scene& scene, const Preparation& prepare = [](WatchedRun&) {}) {
  const Forces forces(scene.structure, scene.gravity);
  WatchedRun watched(
      scene.structure, forces,
      std::make_unique<Solver>(
          scene.structure, forces,
          SolverOptions{.method = scene.method, .step = scene.step, .limit = 0.005, .max_strain = torn_strain},
          scene.start()),
      {.changes_step = scene.changes_step, .energy_scale = scene.scale(), .stretch = 16},
      every(scene.interval, scene.end, scene.begin));
  prepare(watched);
  Outcome outcome;
  try {
    while (auto sample = watched.next()) {
      outcome.energy.push_back(kinetic_energy(scene.structure, sample->state) + forces.potential_energy(sample->state));
      outcome.samples.push_back(std::move(*sample));
    }
  } catch (const DivergenceError& error) {
    outcome.divergence = error.what();
  }
  outcome.incidents = watched.incidents();
  outcome.steps = watched.steps();
  outcome.solves = watched.solve_counts();
  outcome.halvings_at_the_end = watched.solver().halvings();
  return outcome;
}

// A run that goes on from a checkpoint delivers what one that never stopped does, to the bit, and tells the same of it.
class GoingOn : public testing::TestWithParam<Method> {};

TEST_P(GoingOn, IsTheRunThatNeverStopped) {
  Scene scene;
  scene.method = GetParam();
  scene.velocity = {20.0, 5.0, 30.0};
  scene.step = is_explicit(scene.method) ? 0.004 : 0.01, scene.end = 16.0;
  std::vector<WatchedRun::Checkpoint> checkpoints;
  const auto watched = [&](WatchedRun& run) {
    run.watch_checkpoints([&](const auto& checkpoint) { checkpoints.push_back(checkpoint); });
  };
  const Outcome whole = run(scene, watched);
  ASSERT_GE(checkpoints.size(), 2U);
  const WatchedRun::Checkpoint from = checkpoints[checkpoints.size() / 2];
  Scene rest = scene;
  rest.begin = from.solver.state.time;
  const Outcome later = run(rest, [&](WatchedRun& run) { run.go_on_from(from); });
  const std::size_t before = whole.samples.size() - later.samples.size();
  ASSERT_GT(later.samples.size(), 10U);
  for (std::size_t k = 0; k < later.samples.size(); ++k) {
    ASSERT_EQ(later.samples[k].time, whole.samples[before + k].time);
    ASSERT_EQ(later.samples[k].state.position, whole.samples[before + k].state.position) << k;
    ASSERT_EQ(later.samples[k].state.velocity, whole.samples[before + k].state.velocity) << k;
  }
  EXPECT_EQ(later.steps, whole.steps);
  ASSERT_EQ(later.incidents.size(), whole.incidents.size());
  for (std::size_t k = 0; k < whole.incidents.size(); ++k) EXPECT_EQ(later.incidents[k].end, whole.incidents[k].end);
  EXPECT_EQ(later.solves.iterations, whole.solves.iterations);
}

INSTANTIATE_TEST_SUITE_P(Methods, GoingOn, testing::Values(Method::fb_euler, Method::backward_euler, Method::imex));

TEST(WatchedRun, IsTheSolverWhereAllIsWell) {
  Scene scene;
  scene.step = 0.002;
  const Outcome watched = run(scene);
  const Forces forces(scene.structure, scene.gravity);
  Solver solver(scene.structure, forces, {.step = scene.step}, scene.start());
  ASSERT_EQ(watched.samples.size(), 100U);
  for (const auto& [time, state] : watched.samples) {
    const State expected = solver.sample(time);
    ASSERT_EQ(state.position, expected.position) << time;
    ASSERT_EQ(state.velocity, expected.velocity) << time;
  }
  EXPECT_EQ(watched.steps, solver.steps());
  EXPECT_TRUE(watched.incidents.empty());
}

/// Thrown so fast that particles cross several rest lengths in a step.
Scene thrown() {
  Scene scene;
  scene.velocity = {20.0, 5.0, 30.0};
  return scene;
}

TEST(WatchedRun, TakesSmallerStepsWhereAThrownClothGainsEnergy) {
  const Outcome outcome = run(thrown());
  EXPECT_EQ(outcome.divergence, "");
  EXPECT_EQ(outcome.samples.size(), 100U);
  ASSERT_FALSE(outcome.incidents.empty());
  EXPECT_LT(outcome.climb(), 0.06 * thrown().scale());
  const Incident& first = outcome.incidents.front();
  EXPECT_GE(first.halvings, 1);
  EXPECT_GT(first.discarded, 0);
  EXPECT_LT(first.begin, first.seen);
  EXPECT_LE(first.seen, first.end);
  // Without: the given step stays, and it is said that the energy climbs, or the run ends.
  Scene given = thrown();
  given.changes_step = false;
  const Outcome unchanged = run(given);
  EXPECT_TRUE(unchanged.climb() > 0.2 * given.scale() || !unchanged.divergence.empty());
  ASSERT_FALSE(unchanged.incidents.empty());
  EXPECT_EQ(unchanged.incidents.front().halvings, 0);
}

// Which steps are taken depends on the run, not on when it is looked at.
TEST(WatchedRun, TakesTheSameStepsWhateverIsSampled) {
  Scene often = thrown(), seldom = thrown();
  often.interval = 0.01, seldom.interval = 0.05;
  const Outcome a = run(often), b = run(seldom);
  ASSERT_EQ(a.incidents.size(), b.incidents.size());
  for (std::size_t k = 0; k < b.samples.size(); ++k)
    ASSERT_TRUE(a.samples[5 * k].state.position == b.samples[k].state.position) << k;
}

TEST(WatchedRun, MendsAStepFarBeyondTheLimit) {
  Scene scene;
  scene.step = 0.03;
  const Outcome outcome = run(scene);
  EXPECT_EQ(outcome.divergence, "");
  EXPECT_LT(outcome.climb(), 0.05 * scene.scale());
  ASSERT_FALSE(outcome.incidents.empty());
  EXPECT_EQ(outcome.incidents.front().kind, Incident::Kind::divergence);
}

TEST(WatchedRun, StopsAGivenStepThatDivergesAfterTheStatesBefore) {
  Scene scene;
  scene.step = 0.03, scene.changes_step = false;
  const Outcome outcome = run(scene);
  EXPECT_THAT(outcome.divergence, HasSubstr("the step was 0.03 s and the limit for fb_euler is 0.005 s"));
  EXPECT_GE(outcome.samples.size(), 1U);
  EXPECT_LT(outcome.samples.size(), 100U);
}

/// Springs that their own weight pulls to thousands of lengths.
Scene torn() {
  Scene scene;
  scene.structure = test::fixed_chain({.free_particles = 3, .mass = 1.0, .stiffness = 1e-4, .second_wall = false});
  scene.gravity = {9.81, 0.0, 0.0};
  scene.step = 0.01, scene.end = 60.0, scene.interval = 1.0;
  return scene;
}

TEST(WatchedRun, SaysThatWeightTearsAClothWhateverTheStep) {
  const Outcome outcome = run(torn());
  EXPECT_THAT(outcome.divergence, HasSubstr("no step is to blame: the springs are too soft for what pulls at them"));
  EXPECT_GE(outcome.samples.size(), 10U);
  Scene fast = torn();
  fast.gravity.setZero();
  fast.velocity = {400.0, 0.0, 0.0};
  EXPECT_THAT(run(fast).divergence, HasSubstr("too soft for the speed that the body starts with"));
}

TEST(WatchedRun, TakesWholeStepsAgainWhenAllIsCalm) {
  Scene scene = thrown();
  scene.structure.body[0].friction = 0.004;  // what was thrown comes to rest
  scene.end = 20.0;
  const Outcome outcome = run(scene);
  ASSERT_FALSE(outcome.incidents.empty());
  EXPECT_EQ(outcome.halvings_at_the_end, 0);
  EXPECT_LT(outcome.incidents.back().end, 19.0);
}

// A fish swims by what its muscles put in: counted, that is no climb, and the watch leaves it alone however little the
// run turns over.
TEST(WatchedRun, CountsTheWorkOfMuscles) {
  const test::Swimmer swimmer(test::swimming());
  const double turned_over = 2.0;  // [J]
  WatchedRun watched(swimmer.structure, *swimmer.forces,
                     std::make_unique<Solver>(swimmer.structure, *swimmer.forces, SolverOptions{.step = 0.002},
                                              rest_state(swimmer.structure)),
                     {.energy_scale = turned_over}, every(0.04, 4.0));
  double most = 0.0;
  while (const auto sample = watched.next())
    most = std::max(most,
                    kinetic_energy(swimmer.structure, sample->state) + swimmer.forces->potential_energy(sample->state));
  EXPECT_GT(most, 0.1 * turned_over);
  EXPECT_TRUE(watched.incidents().empty());
  EXPECT_GT(watched.solver().work(), most);
}

TEST(Solver, TakesWorkBackWithItsSteps) {
  const test::Swimmer swimmer(test::swimming());
  Solver solver(swimmer.structure, *swimmer.forces, {.step = 0.002}, rest_state(swimmer.structure));
  solver.sample(1.0);
  const Solver::Checkpoint good = solver.checkpoint();
  const double before = solver.work();
  solver.sample(1.5);
  EXPECT_NE(solver.work(), before);
  solver.go_back(good);
  EXPECT_EQ(solver.work(), before);
}

// Half a period in hand: steps of halves, quarters and eighths end where whole ones do.
TEST(Solver, KeepsItsTimesThroughHalvedSteps) {
  const Structure structure = test::oscillator(1.0, 1.0);
  const Forces forces(structure, Eigen::Vector3d::Zero());
  Solver solver(structure, forces, {.step = 0.1}, rest_state(structure));
  for (int k = 1; k <= 1000; ++k) {
    solver.set_halvings(k % 11);
    for (int part = 0; part < 1 << (k % 11); ++part) solver.advance();
    ASSERT_EQ(solver.state().time, static_cast<double>(k) * 0.1);
  }
}

TEST(Solver, GoesBackToACheckpointExactly) {
  const Structure structure = test::light_cloth(5, 5, {0});
  const Forces forces(structure, {0.0, -9.81, 0.0});
  Solver solver(structure, forces, {.step = 0.004}, rest_state(structure));
  solver.sample(0.1);
  const Solver::Checkpoint good = solver.checkpoint();
  const State once = solver.sample(0.2037);
  solver.go_back(good);
  const State again = solver.sample(0.2037);
  EXPECT_EQ(once.position, again.position);
  EXPECT_EQ(once.velocity, again.velocity);
}

/// A force that does work and does not say so: no step mends that.
class Wind : public ForceLaw {
 public:
  std::string_view name() const override { return "wind"; }
  void add_force(const State&, Eigen::MatrixX3d& force) const override { force.col(0).array() += 0.05; }
  double energy(const State&) const override { return 0.0; }
  void add_linearisation(const State&, double, double, JacobianForm, StiffnessMatrix&) const override {}
  bool add_bound(Shapes, Linearisation&) const override { return true; }
  void add_least_damping(StiffnessMatrix&) const override {}
  bool passive() const override { return true; }
  double work(const State&, const State&) const override { return 0.0; }
  bool join(FusedSweep&) const override { return false; }
};

TEST(WatchedRun, GoesOnWhereNoStepChangesTheClimb) {
  const Scene scene;
  Forces forces(scene.structure, scene.gravity);
  forces.add(std::make_unique<Wind>());
  WatchedRun watched(
      scene.structure, forces,
      std::make_unique<Solver>(scene.structure, forces, SolverOptions{.step = scene.step}, scene.start()),
      {.energy_scale = scene.scale()}, every(0.02, 1.0));
  int samples = 0;
  while (watched.next()) ++samples;
  EXPECT_EQ(samples, 50);
  ASSERT_FALSE(watched.incidents().empty());
  for (const Incident& incident : watched.incidents()) EXPECT_EQ(incident.kind, Incident::Kind::unexplained);
  EXPECT_EQ(watched.incidents().front().halvings, 1) << "one smaller step is enough to tell";
}

}  // namespace
}  // namespace billow::sim
