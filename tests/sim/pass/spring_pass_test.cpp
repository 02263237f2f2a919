// The vector passes against the plain loop over springs, and against themselves: the same bits on every instruction
// set that this machine has and with any number of threads.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>

#include "base/random.h"
#include "sim/filter/filter.h"
#include "sim/force/fluid_friction.h"
#include "sim/force/forces.h"
#include "sim/force/gravity.h"
#include "sim/force/spring_force.h"
#include "sim/pass/spring_plan.h"
#include "sim/step/step.h"
#include "tests/support/evaluations.h"
#include "tests/support/filters.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::grid;
using test::on_every_instruction_set;
using test::shaken_state;

/// The structure with its particles numbered at random, like a mesh from a careless exporter.
Structure shuffled(const Structure& structure) {
  std::vector<int> number(structure.particles());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), std::mt19937(3));
  Structure result = structure;
  result.rest_position(number, Eigen::all) = structure.rest_position;
  result.mass(number) = structure.mass;
  result.inverse_mass(number) = structure.inverse_mass;
  for (int s = 0; s < structure.springs(); ++s) {
    const auto [low, high] = std::minmax(number[structure.spring(s, 0)], number[structure.spring(s, 1)]);
    result.spring.row(s) << low, high;
  }
  return result;
}

// Widths around the vectors' and the groups' sizes, in one body and two; regular, shuffled, and of uneven stiffness.
std::vector<Structure> structures() {
  std::vector<Structure> list;
  for (const int width : {2, 3, 5, 8, 17, 40})
    for (const bool damped : {false, true})
      for (const DampingModel model : {DampingModel::projected, DampingModel::spring}) {
        Structure sheet = grid({.width = width, .height = width + 1, .structural = 100.0, .shear = 70.0, .bend = 30.0});
        if (damped) sheet.damping.setConstant(0.3);
        sheet.body[0].damping_model = model;
        Structure uneven = sheet;
        uneven.stiffness(0) *= 2.0;
        list.push_back(merge({sheet, shuffled(sheet), uneven}));
      }
  return list;
}

// What the sweep makes of springs alone; SpringForce::add_force itself is a plain loop.
Eigen::MatrixX3d vector_force(const Structure& structure, const State& state) {
  Forces springs(structure);
  springs.add(std::make_unique<SpringForce>(structure));
  return test::force_of(springs, state);
}

Eigen::MatrixX3d plain_force(const Structure& structure, const State& state) {
  Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(structure.particles(), 3);
  for (const Body& body : structure.body)
    for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
      const int i = structure.spring(s, 0), j = structure.spring(s, 1);
      const Eigen::RowVector3d d = state.position.row(j) - state.position.row(i);
      const Eigen::RowVector3d w = state.velocity.row(j) - state.velocity.row(i);
      const double length = d.norm(), c = structure.damping(s);
      Eigen::RowVector3d pull = Eigen::RowVector3d::Zero();
      if (length > 0.0) pull = structure.stiffness(s) * (length - structure.rest_length(s)) / length * d;
      if (body.damping_model == DampingModel::spring) pull += c * w;
      if (body.damping_model == DampingModel::projected && length > 0.0) pull += c * d.dot(w) / d.squaredNorm() * d;
      force.row(i) += pull;
      force.row(j) -= pull;
    }
  return force;
}

State shaken(const Structure& structure) {
  State state = shaken_state(structure, 0.3, 1.0);
  state.position.row(1) = state.position.row(0);  // a spring of zero length
  return state;
}

TEST(SpringPlan, TakesRegularNumberingsAsBandsAndOthersAsSlices) {
  const Structure sheet = grid({.width = 9, .height = 9});
  const SpringPlan regular(sheet), irregular(shuffled(sheet));
  ASSERT_EQ(regular.bands.size(), 1u);
  EXPECT_EQ(regular.bands[0].stride, (std::vector<int>{1, 2, 8, 9, 10, 18}));
  EXPECT_TRUE(regular.slices.empty());
  EXPECT_TRUE(irregular.bands.empty());
  ASSERT_EQ(irregular.slices.size(), 1u);
}

TEST(SpringPlan, NumbersAnIrregularBodySoThatNeighboursAreNear) {
  const Structure sheet = shuffled(grid({.width = 60, .height = 60}));
  const SpringPlan plan(sheet);
  const SpringSlices& slices = plan.slices.at(0);
  ASSERT_EQ(slices.order.size(), 3600u);
  std::vector<int> sorted = slices.order;
  std::sort(sorted.begin(), sorted.end());
  for (int i = 0; i < 3600; ++i) ASSERT_EQ(sorted[i], i);
  EXPECT_LT(4 * slices.reach, 6 * 60);
}

TEST(SpringPass, IsThePlainLoopToRounding) {
  for (const Structure& structure : structures()) {
    const State state = shaken(structure);
    const Eigen::MatrixX3d expected = plain_force(structure, state);
    EXPECT_LT((vector_force(structure, state) - expected).norm(), 1e-14 * expected.norm());
  }
}

TEST(SpringPass, HasTheSameBitsOnEveryInstructionSet) {
  for (const Structure& structure : structures()) {
    const State state = shaken(structure);
    const Eigen::MatrixX3d expected = vector_force(structure, state);
    on_every_instruction_set([&] { EXPECT_EQ(vector_force(structure, state), expected); });
  }
}

TEST(FilterPass, HasTheSameBitsOnEveryInstructionSet) {
  for (const Structure& structure : structures())
    for (const FilterForm form : {FilterForm::plain, FilterForm::conserving}) {
      const Filter filter(structure, {.form = form, .passes = 2});
      const auto filtered = [&] {
        Eigen::MatrixX3d field = seeded_noise(structure.particles(), 5);
        test::apply(filter, structure.rest_position, 0.0, field);
        return field;
      };
      const Eigen::MatrixX3d expected = filtered();
      on_every_instruction_set([&] { EXPECT_EQ(filtered(), expected); });
    }
}

// A force that is not a spring's, so that a sweep has one to add.
class Wind : public ForceLaw {
 public:
  std::string_view name() const override { return "wind"; }
  void add_force(const State& state, Eigen::MatrixX3d& force) const override { force += 0.1 * state.position; }
  double energy(const State&) const override { return 0.0; }
  void add_linearisation(const State&, double, double, JacobianForm, StiffnessMatrix&) const override {}
  bool add_bound(Shapes, Linearisation&) const override { return false; }
  void add_least_damping(StiffnessMatrix&) const override {}
  bool passive() const override { return false; }
  double work(const State&, const State&) const override { return 0.0; }
  bool join(FusedSweep&) const override { return false; }
};

// Every structure of the tests, with friction, a pinned particle and a body of springs that only the plain loop knows.
Structure pinned_and_rubbed(Structure structure) {
  Structure buckling = grid({.width = 4, .height = 3, .structural = 100.0});
  buckling.body[0].spring_model = SpringModel::choi_ko;
  structure = merge({structure, buckling});
  structure.inverse_mass(0) = 0.0;
  for (Body& body : structure.body) body.friction = 0.02;
  return structure;
}

// The springs' sums, then each other law's force, one after another.
Eigen::MatrixX3d summed(const Structure& structure, const State& state, const Eigen::Vector3d& gravity) {
  Eigen::MatrixX3d force = vector_force(structure, state);
  FluidFriction(structure).add_force(state, force);
  Gravity(structure, gravity).add_force(state, force);
  Wind().add_force(state, force);
  return force;
}

TEST(Sweep, IsTheSumOfTheLawsBitForBit) {
  for (const Structure& plain : structures()) {
    const Structure structure = pinned_and_rubbed(plain);
    Forces forces(structure, {0.0, -9.81, 0.0});
    forces.add(std::make_unique<Wind>());
    const State state = shaken(structure);
    Eigen::MatrixX3d expected = summed(structure, state, {0.0, -9.81, 0.0}), acceleration, kicked;
    on_every_instruction_set([&] { EXPECT_EQ(test::force_of(forces, state), expected); });
    for (int axis = 0; axis < 3; ++axis) expected.col(axis).array() *= structure.inverse_mass.array();
    on_every_instruction_set([&] {
      acceleration = test::acceleration_of(forces, state);
      EXPECT_EQ(acceleration, expected);
      kicked = test::kicked(forces, state, 0.01);
      EXPECT_EQ(kicked, (state.velocity + 0.01 * expected).eval());
    });
  }
}

TEST(FilterPass, MovesAndKicksInOnePassBitForBit) {
  for (const Structure& plain : structures())
    for (const int passes : {1, 3}) {
      const Structure structure = pinned_and_rubbed(plain);
      const Filter filter(structure, {.passes = passes});
      const State state = shaken(structure);
      on_every_instruction_set([&] { test::expect_moves_and_kicks_as_applied(filter, structure, state); });
    }
}

TEST(Step, HasTheSameBitsWithAnyNumberOfThreads) {
  const oneapi::tbb::global_control more_than_cores(oneapi::tbb::global_control::max_allowed_parallelism, 8);
  const Structure sheet = grid({.width = 120, .height = 110, .structural = 100.0, .shear = 70.0, .bend = 30.0});
  const Structure structure = merge({sheet, shuffled(sheet)});
  const Forces forces(structure, {0.0, -9.81, 0.0});
  const Filter filter(structure, {});
  const auto run = [&](int threads) {
    State state = shaken_state(structure, 0.05, 1.0);
    oneapi::tbb::task_arena(threads).execute([&] {
      Step step(forces, Method::fb_euler, {}, &filter);
      for (int k = 0; k < 5; ++k) step(state, 0.01);
    });
    return state;
  };
  const State expected = run(1);
  for (const int threads : {2, 4, 8}) {
    const State state = run(threads);
    EXPECT_EQ(state.position, expected.position) << threads;
    EXPECT_EQ(state.velocity, expected.velocity) << threads;
  }
}

}  // namespace
}  // namespace billow::sim
