// What every filter does and leaves alone, and where a step applies it.
#include "sim/filter/filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "sim/step/step.h"
#include "tests/support/evaluations.h"
#include "tests/support/filters.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::all_forms;
using test::dense_filter;
using test::filtered;
using test::grid;
using test::masses_of_axes;
using test::pinned_sheet;
using test::ring;
using test::shaken_state;
using test::three_in_a_row;
using test::varied_options;
using test::weights;
using test::with_uneven_masses;

TEST(Filter, LeavesAConstantFieldAlone) {
  const Structure structure = pinned_sheet();
  const State state = shaken_state(structure, 0.03, 0.0);
  for (const FilterOptions& options : varied_options()) {
    const Eigen::MatrixX3d constant = Eigen::RowVector3d(1.0, -2.0, 3.0).replicate(structure.particles(), 1);
    Eigen::MatrixX3d field = constant;
    test::apply(Filter(structure, options), state.position, 0.0, field);
    EXPECT_LT((field - constant).norm(), 1e-13);
  }
}

TEST(Filter, NeverChangesAPinnedParticleButCountsItAsANeighbour) {
  const Structure structure = pinned_sheet();
  for (FilterOptions options : varied_options()) {
    options.passes = 3;
    const Eigen::MatrixX3d field = seeded_noise(structure.particles(), 3);
    const Eigen::MatrixX3d after = filtered(structure, options, field);
    for (const int pin : {0, 5, 17}) EXPECT_EQ(after.row(pin), field.row(pin));
    EXPECT_GT(weights(structure, options)(1, 0), 0.0);
  }
}

TEST(Filter, AppliesItsWeightsOncePerPass) {
  const Structure structure = pinned_sheet();
  const Eigen::MatrixX3d field = seeded_noise(structure.particles(), 3);
  for (const FilterForm form : all_forms)
    for (const int passes : {1, 2, 5}) {
      Eigen::MatrixX3d expected = field;
      for (int k = 0; k < passes; ++k) expected = weights(structure, {.form = form}) * expected;
      EXPECT_LT((filtered(structure, {.form = form, .passes = passes}, field) - expected).norm(), 1e-13);
    }
}

TEST(Filter, WithLargeLambdaDoesNothing) {
  const Structure structure = pinned_sheet();
  const Eigen::MatrixX3d field = seeded_noise(structure.particles(), 3);
  for (FilterOptions options : varied_options()) {
    options.lambda = 1000.0;
    EXPECT_LT((filtered(structure, options, field) - field).norm(), 1e-12);
  }
}

// The check that lambda is in units of the rest length: the paper's Figure 6 has no effect left at about 10.
TEST(Filter, IsSpentAtLambdaTenWhateverTheUnitOfLength) {
  for (const double spacing : {0.01, 1.0, 50.0}) {
    const Structure structure = grid({.width = 6, .height = 6, .spacing = spacing});
    const Eigen::MatrixX3d field = seeded_noise(36, 3);
    EXPECT_LT((filtered(structure, {.lambda = 10.0}, field) - field).norm(), 5e-4 * field.norm());
    EXPECT_LT((weights(structure, {}) - weights(grid({.width = 6, .height = 6}), {})).norm(), 1e-13);
  }
}

TEST(Filter, KnowsWhetherItIsSelfAdjointAndHasItsAdjoint) {
  for (const FilterForm form : all_forms)
    for (const int passes : {1, 2}) {
      const Structure structure = with_uneven_masses(grid({.width = 4, .height = 3, .spacing = 0.1}), 0.8);
      const Filter filter(structure, {.form = form, .passes = passes});
      EXPECT_EQ(filter.self_adjoint(), form == FilterForm::conserving);
      const Eigen::VectorXd mass = masses_of_axes(structure);
      const Eigen::MatrixXd expected =
          mass.cwiseInverse().asDiagonal() * dense_filter(structure, filter).transpose() * mass.asDiagonal();
      EXPECT_LT((dense_filter(structure, filter.adjoint()) - expected).norm(), 1e-12 * expected.norm());
    }
  const Structure even = ring(12, 1.0, 1.0);
  for (const FilterForm form : all_forms) EXPECT_TRUE(Filter(even, {.form = form}).self_adjoint());
}

TEST(Filter, FrozenIsWhatItIsAtThatTime) {
  const Structure structure = with_uneven_masses(grid({.width = 5, .height = 4}), 0.5);
  for (const FilterForm form : all_forms) {
    const Filter filter(structure, {.lambda = 2.0, .form = form, .lambda_keys = {{0.0, 1.0}, {4.0, 0.25}}});
    EXPECT_FALSE(filter.constant_weights());
    for (const double time : {0.0, 1.0, 4.0}) {
      const Filter frozen = filter.frozen(time);
      EXPECT_TRUE(frozen.constant_weights());
      EXPECT_LT((Eigen::MatrixXd(frozen.weights(structure.rest_position, 0.0)) -
                 Eigen::MatrixXd(filter.weights(structure.rest_position, time)))
                    .norm(),
                1e-14);
    }
  }
}

TEST(FilterOptions, SayWhenTheFilterIsWeakestAndStrongest) {
  const FilterOptions keyed{.lambda_keys = {{1.0, 0.5}, {2.0, 3.0}, {9.0, 0.1}}};
  EXPECT_EQ(times_of_extremes(keyed, 10.0), (std::vector<double>{2.0, 10.0}));
  EXPECT_EQ(times_of_extremes(keyed, 1.5), (std::vector<double>{1.5, 0.0}));  // the later keys never come
  EXPECT_EQ(times_of_extremes({}, 10.0), std::vector<double>{0.0});
}

TEST(Filter, NeverMixesBodiesEvenWhereTheyTouch) {
  const Structure sheet = grid({.width = 4, .height = 4}), hoop = ring(7, 2.0, 1.0);
  const Structure both = merge({sheet, hoop});  // in one place
  for (const FilterOptions& options : varied_options()) {
    const Eigen::MatrixX3d field = seeded_noise(both.particles(), 8);
    const Eigen::MatrixX3d after = filtered(both, options, field);
    EXPECT_LT((after.topRows(16) - filtered(sheet, options, field.topRows(16))).norm(), 1e-14);
    EXPECT_LT((after.bottomRows(7) - filtered(hoop, options, field.bottomRows(7))).norm(), 1e-14);
  }
}

TEST(Filter, RefusesOptionsOutOfTheirRange) {
  const Structure row = three_in_a_row();
  const double nan = std::nan("");
  const auto refused = [&](const FilterOptions& options) { EXPECT_THROW(Filter(row, options), InputError); };
  for (const double bad : {0.0, -1.0, nan, HUGE_VAL}) refused({.lambda = bad});
  for (const int bad : {0, -1}) refused({.passes = bad});
  for (const double bad : {0.0, -1.0, nan}) refused({.neighbours = FilterNeighbours::radius, .radius = bad});
  refused({.particle_lambda = Eigen::Vector2d(1.0, 1.0)});
  for (const double bad : {0.0, -1.0, nan, HUGE_VAL}) {
    refused({.particle_lambda = Eigen::Vector3d(1.0, bad, 1.0)});
    refused({.lambda_keys = {{0.0, 1.0}, {1.0, bad}}});
  }
  refused({.lambda_keys = {{1.0, 1.0}, {0.5, 2.0}}});
}

TEST(Filter, OfForcesNeedsAnExplicitMethod) {
  const Structure row = three_in_a_row();
  const Forces forces(row, Eigen::Vector3d::Zero());
  const Filter filter(row, {.target = FilterTarget::force});
  for (const Method method : {Method::backward_euler, Method::imex})
    EXPECT_THROW(Step(forces, method, {}, &filter), InputError);
  for (const Method method : {Method::forward_euler, Method::fb_euler, Method::verlet, Method::rk4})
    EXPECT_NO_THROW(Step(forces, method, {}, &filter));
}

// v' = F (v + h a), x' = x + h v': before the position moves.
TEST(Step, FiltersVelocitiesBeforeThePositionsMoveByThem) {
  const Structure structure = pinned_sheet();
  const Forces forces(structure, {0.0, -9.81, 0.0});
  const Filter filter(structure, {});
  Step step(forces, Method::fb_euler, {}, &filter);
  const State start = shaken_state(structure, 0.01, 1.0);
  State state = start;
  step(state, 0.01);
  Eigen::MatrixX3d velocity;
  velocity = test::acceleration_of(forces, start);
  velocity = start.velocity + 0.01 * velocity;
  test::apply(filter, start.position, 0.0, velocity);
  EXPECT_LT((state.velocity - velocity).norm(), 1e-13 * velocity.norm());
  EXPECT_LT((state.position - (start.position + 0.01 * velocity)).norm(), 1e-14);
}

// v' = v + h F a.
TEST(Step, FiltersForcesAsAccelerations) {
  const Structure structure = pinned_sheet();
  const Forces forces(structure, {0.0, -9.81, 0.0});
  const Filter filter(structure, {.target = FilterTarget::force});
  Step step(forces, Method::fb_euler, {}, &filter);
  const State start = shaken_state(structure, 0.01, 1.0);
  State state = start;
  step(state, 0.01);
  Eigen::MatrixX3d acceleration;
  acceleration = test::acceleration_of(forces, start);
  test::apply(filter, start.position, 0.0, acceleration);
  EXPECT_LT((state.velocity - (start.velocity + 0.01 * acceleration)).norm(), 1e-13 * state.velocity.norm());
}

}  // namespace
}  // namespace billow::sim
