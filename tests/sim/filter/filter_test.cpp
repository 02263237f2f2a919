// The filter against its definition: weights by hand, what it leaves alone, what it conserves.
#include "sim/filter/filter.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "sim/body/momenta.h"
#include "sim/step/step.h"
#include "tests/support/evaluations.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::fixed_chain;
using test::grid;
using test::ring;
using test::shaken_state;
using test::with_uneven_masses;

constexpr FilterForm all_forms[] = {FilterForm::plain, FilterForm::symmetric, FilterForm::conserving};

/// Three free particles in a row, springs of 0.5 m: distances 1 and 1 in units of the mean rest length.
Structure three_in_a_row() {
  Structure row = fixed_chain({.free_particles = 2, .rest_length = 0.5, .second_wall = false});
  row.inverse_mass.setOnes();
  return row;
}

Eigen::MatrixXd weights(const Structure& structure, const FilterOptions& options, double time = 0.0) {
  return Eigen::MatrixXd(Filter(structure, options).weights(structure.rest_position, time));
}

Eigen::MatrixX3d filtered(const Structure& structure, const FilterOptions& options, Eigen::MatrixX3d field) {
  test::apply(Filter(structure, options), structure.rest_position, 0.0, field);
  return field;
}

TEST(FilterWeights, AreThoseComputedByHandForThreeParticles) {
  const double e = std::exp(-1.0);
  Eigen::Matrix3d expected;
  expected << 1 / (1 + e), e / (1 + e), 0,                //
      e / (1 + 2 * e), 1 / (1 + 2 * e), e / (1 + 2 * e),  //
      0, e / (1 + e), 1 / (1 + e);
  EXPECT_LT((weights(three_in_a_row(), {}) - expected).norm(), 1e-15);
  const Eigen::MatrixX3d field = seeded_noise(3, 1);
  EXPECT_LT((filtered(three_in_a_row(), {}, field) - expected * field).norm(), 1e-15);
}

TEST(FilterWeights, OfTheSymmetricFormAreHalfThoseOfThePlainOne) {
  const Structure structure = grid({.width = 5, .height = 4});
  const Eigen::MatrixXd plain = weights(structure, {}), identity = Eigen::MatrixXd::Identity(20, 20);
  EXPECT_LT((weights(structure, {.form = FilterForm::symmetric}) - 0.5 * (identity + plain)).norm(), 1e-14);
}

TEST(FilterWeights, OfTheGaussianFallWithTheSquareOfTheDistance) {
  const double near = std::exp(-0.5 * 0.64), far = std::exp(-0.5 * 4.0 * 0.64);  // lambda d = 0.8 and 1.6
  const Eigen::MatrixXd b =
      weights(three_in_a_row(),
              {.kernel = FilterKernel::gaussian, .lambda = 0.8, .neighbours = FilterNeighbours::radius, .radius = 2.5});
  EXPECT_NEAR(b(0, 0), 1.0 / (1.0 + near + far), 1e-15);
  EXPECT_NEAR(b(0, 1), near / (1.0 + near + far), 1e-15);
  EXPECT_NEAR(b(0, 2), far / (1.0 + near + far), 1e-15);
}

std::vector<FilterOptions> varied_options() {
  std::vector<FilterOptions> list;
  for (const FilterForm form : all_forms)
    for (const FilterKernel kernel : {FilterKernel::exponential, FilterKernel::gaussian})
      for (const FilterNeighbours neighbours : {FilterNeighbours::springs, FilterNeighbours::radius})
        for (const FilterDistances distances : {FilterDistances::rest, FilterDistances::current})
          list.push_back({.kernel = kernel, .form = form, .neighbours = neighbours, .distances = distances});
  return list;
}

Structure pinned_sheet() {
  return with_uneven_masses(grid({.width = 6, .height = 5, .spacing = 0.1, .mass = 0.01, .pinned = {0, 5, 17}}), 0.4);
}

TEST(FilterWeights, SumToOneInEveryRowAndAreNeverNegative) {
  const Structure structure = pinned_sheet();
  const State state = shaken_state(structure, 0.03, 0.0);
  for (const FilterOptions& options : varied_options()) {
    const Eigen::MatrixXd b(Filter(structure, options).weights(state.position, 0.0));
    EXPECT_LT((b.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-14);
    EXPECT_GE(b.minCoeff(), 0.0);
  }
}

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

TEST(FilterNeighbours, ByRadiusAreAllParticlesWithinIt) {
  Structure structure = pinned_sheet();
  structure.rest_position = shaken_state(structure, 0.04, 0.0).position;  // pins count like any other
  for (const double radius : {0.5, 1.3, 2.7}) {
    const Eigen::MatrixXd b = weights(structure, {.neighbours = FilterNeighbours::radius, .radius = radius});
    for (int i = 0; i < structure.particles(); ++i)
      for (int j = 0; j < structure.particles(); ++j) {
        const double distance = (structure.rest_position.row(i) - structure.rest_position.row(j)).norm() / 0.1;
        EXPECT_EQ(b(i, j) > 0.0, structure.pinned(i) ? i == j : distance <= radius) << i << " " << j;
      }
  }
}

// 12 lattice points lie within two spacings of one; those at exactly two must not come and go with rounding.
TEST(FilterNeighbours, AtExactlyTheRadiusCountDespiteRounding) {
  for (const double spacing : {0.1, 1.0 / 49.0, 0.3, 0.7}) {
    const Structure structure = grid({.width = 15, .height = 15, .spacing = spacing});
    const Eigen::MatrixXd b = weights(structure, {.neighbours = FilterNeighbours::radius, .radius = 2.0});
    for (int z = 2; z < 13; ++z)
      for (int x = 2; x < 13; ++x)
        ASSERT_EQ((b.row(x + 15 * z).array() > 0.0).count(), 1 + 12) << x << ", " << z << " spaced " << spacing;
  }
}

TEST(FilterNeighbours, BySpringsAreThoseThatShareOne) {
  const Structure structure = pinned_sheet();
  Eigen::MatrixXd joined = Eigen::MatrixXd::Identity(structure.particles(), structure.particles());
  for (int s = 0; s < structure.springs(); ++s)
    joined(structure.spring(s, 0), structure.spring(s, 1)) = joined(structure.spring(s, 1), structure.spring(s, 0)) = 1;
  const Eigen::MatrixXd b = weights(structure, {});
  for (int i = 0; i < structure.particles(); ++i) {
    if (structure.pinned(i)) continue;
    EXPECT_EQ((b.row(i).array() > 0.0).cast<double>().matrix(), joined.row(i));
  }
}

TEST(FilterDistances, CurrentOnesFollowThePositionsAndRestOnesDoNot) {
  const Structure row = three_in_a_row();
  Eigen::MatrixX3d stretched = row.rest_position;
  stretched(2, 0) = 2.0;  // 1.5 m from its neighbour: 3 rest lengths
  const Eigen::MatrixXd rest(Filter(row, {}).weights(stretched, 0.0));
  const Eigen::MatrixXd current(Filter(row, {.distances = FilterDistances::current}).weights(stretched, 0.0));
  EXPECT_EQ(rest, weights(row, {}));
  EXPECT_NEAR(current(2, 1), std::exp(-3.0) / (1.0 + std::exp(-3.0)), 1e-15);
  EXPECT_NEAR(current(0, 1), std::exp(-1.0) / (1.0 + std::exp(-1.0)), 1e-15);
  Eigen::MatrixX3d field = seeded_noise(3, 1);
  const Eigen::MatrixX3d expected = current * field;
  test::apply(Filter(row, {.distances = FilterDistances::current}), stretched, 0.0, field);
  EXPECT_LT((field - expected).norm(), 1e-15);
}

TEST(FilterLambda, VariesLinearlyBetweenKeysAndHoldsOutsideThem) {
  const Structure row = three_in_a_row();
  const FilterOptions options{.lambda = 2.0, .lambda_keys = {{1.0, 0.5}, {3.0, 1.0}, {4.0, 3.0}}};
  for (const auto& [time, factor] :
       {std::pair{0.0, 0.5}, {1.0, 0.5}, {2.0, 0.75}, {3.0, 1.0}, {3.5, 2.0}, {9.0, 3.0}}) {
    const double e = std::exp(-2.0 * factor);
    EXPECT_NEAR(weights(row, options, time)(0, 1), e / (1.0 + e), 1e-15) << time;
    Eigen::MatrixX3d field = Eigen::MatrixX3d::Zero(3, 3);
    field(1, 0) = 1.0;
    test::apply(Filter(row, options), row.rest_position, time, field);
    EXPECT_NEAR(field(0, 0), e / (1.0 + e), 1e-15) << time;
  }
}

TEST(FilterLambda, VariesFromParticleToParticle) {
  FilterOptions options{.lambda = 7.0};  // nowhere
  options.particle_lambda = Eigen::Vector3d(1.0, 2.0, 4.0);
  const Eigen::MatrixXd b = weights(three_in_a_row(), options);
  for (const auto& [i, lambda] : {std::pair{0, 1.0}, {2, 4.0}})
    EXPECT_NEAR(b(i, 1), std::exp(-lambda) / (1.0 + std::exp(-lambda)), 1e-15);
  EXPECT_NEAR(b(1, 0), std::exp(-2.0) / (1.0 + 2.0 * std::exp(-2.0)), 1e-15);
}

State loose_state(const Structure& structure) { return shaken_state(structure, 0.04, 1.0, 21); }

double momentum_scale(const Structure& structure, const State& state) {
  return structure.mass.dot(state.velocity.rowwise().norm());
}

double angular_scale(const Structure& structure, const State& state) {
  return structure.mass.dot(state.position.rowwise().norm().cwiseProduct(state.velocity.rowwise().norm()));
}

TEST(ConservingFilter, KeepsBothMomentaOfAFreeBodyForAnyVelocities) {
  const Structure structure = with_uneven_masses(grid({.width = 6, .height = 5, .spacing = 0.1}), 0.8);
  for (const FilterDistances distances : {FilterDistances::rest, FilterDistances::current})
    for (const FilterNeighbours neighbours : {FilterNeighbours::springs, FilterNeighbours::radius})
      for (const int passes : {1, 4}) {
        const Filter filter(structure, {.lambda = 0.3,
                                        .form = FilterForm::conserving,
                                        .neighbours = neighbours,
                                        .distances = distances,
                                        .passes = passes});
        const State before = loose_state(structure);
        State after = before;
        test::apply(filter, after.position, 0.0, after.velocity);
        EXPECT_GT((after.velocity - before.velocity).norm(), 0.1 * before.velocity.norm()) << "it must filter";
        EXPECT_LT((linear_momentum(structure, after) - linear_momentum(structure, before)).norm(),
                  1e-13 * momentum_scale(structure, before));
        EXPECT_LT((angular_momentum(structure, after) - angular_momentum(structure, before)).norm(),
                  1e-13 * angular_scale(structure, before));
      }
}

TEST(ConservingFilter, KeepsASpinningBodysMomentaThroughAThousandSteps) {
  Structure structure = with_uneven_masses(
      grid({.width = 5, .height = 4, .spacing = 0.1, .structural = 100.0, .shear = 70.0, .bend = 30.0}), 0.5);
  const Forces forces(structure, Eigen::Vector3d::Zero());
  for (const FilterTarget target : {FilterTarget::velocity, FilterTarget::force})
    for (const Method method : {Method::fb_euler, Method::verlet}) {
      SCOPED_TRACE(testing::Message() << name(method) << ", target " << static_cast<int>(target));
      const Filter filter(structure, {.form = FilterForm::conserving, .target = target});
      Step step(forces, method, {}, &filter);
      const State start = loose_state(structure);
      State state = start;
      for (int k = 0; k < 1000; ++k) step(state, 0.005);
      EXPECT_LT((linear_momentum(structure, state) - linear_momentum(structure, start)).norm(),
                1e-10 * momentum_scale(structure, start));
      EXPECT_LT((angular_momentum(structure, state) - angular_momentum(structure, start)).norm(),
                1e-10 * angular_scale(structure, start));
    }
}

// Row-normalised weights conserve neither, which is why the form above exists.
TEST(PlainFilter, LosesMomentum) {
  const Structure structure = grid({.width = 6, .height = 5, .spacing = 0.1});
  const State before = loose_state(structure);
  State after = before;
  test::apply(Filter(structure, {}), after.position, 0.0, after.velocity);
  EXPECT_GT((linear_momentum(structure, after) - linear_momentum(structure, before)).norm(),
            1e-4 * momentum_scale(structure, before));
}

// Of weights that are symmetric in the masses' inner product, over the free particles.
Eigen::VectorXd conserving_spectrum(const Structure& structure, const Eigen::MatrixXd& b) {
  std::vector<int> free;
  for (int i = 0; i < structure.particles(); ++i)
    if (!structure.pinned(i)) free.push_back(i);
  const Eigen::VectorXd root = structure.mass(free).cwiseSqrt();
  const Eigen::MatrixXd symmetric = root.asDiagonal() * b(free, free) * root.cwiseInverse().asDiagonal();
  EXPECT_LT((symmetric - symmetric.transpose()).norm(), 1e-14);
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric).eigenvalues();
}

Eigen::MatrixXd dense_filter(const Structure& structure, const Filter& filter) {
  const int n = structure.particles();
  Eigen::MatrixXd matrix(3 * n, 3 * n);
  for (int c = 0; c < 3 * n; ++c) {
    Eigen::MatrixX3d unit = Eigen::MatrixX3d::Zero(n, 3);
    unit(c / 3, c % 3) = 1.0;
    test::apply(filter, structure.rest_position, 0.0, unit);
    for (int r = 0; r < 3 * n; ++r) matrix(r, c) = unit(r / 3, r % 3);
  }
  return matrix;
}

Eigen::VectorXd masses_of_axes(const Structure& structure) {
  Eigen::VectorXd mass(3 * structure.particles());
  for (int r = 0; r < mass.size(); ++r) mass(r) = structure.mass(r / 3);
  return mass;
}

// A free body's rigid motions pass as they are, so the whole operator is symmetric in the masses' inner product.
TEST(ConservingFilter, IsSelfAdjointWithItsRigidMotions) {
  const Structure structure = with_uneven_masses(grid({.width = 4, .height = 3, .spacing = 0.1}), 0.8);
  const Filter filter(structure, {.lambda = 0.3, .form = FilterForm::conserving});
  EXPECT_TRUE(filter.self_adjoint());
  const Eigen::MatrixXd weighted = masses_of_axes(structure).asDiagonal() * dense_filter(structure, filter);
  EXPECT_LT((weighted - weighted.transpose()).norm(), 1e-13 * weighted.norm());
  Eigen::MatrixX3d spin(structure.particles(), 3);
  for (int i = 0; i < structure.particles(); ++i)
    spin.row(i) =
        Eigen::RowVector3d(0.3, -1.0, 2.0).cross(structure.rest_position.row(i)) + Eigen::RowVector3d(4.0, 5.0, 6.0);
  Eigen::MatrixX3d after = spin;
  test::apply(filter, structure.rest_position, 0.0, after);
  EXPECT_LT((after - spin).norm(), 1e-13 * spin.norm());
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

// Symmetric in the masses' inner product and never negative, so a force filter with it leaves every frequency real.
TEST(ConservingFilter, HasItsSpectrumBetweenZeroAndOne) {
  for (const FilterNeighbours neighbours : {FilterNeighbours::springs, FilterNeighbours::radius})
    for (const double lambda : {0.2, 1.0})
      for (const Structure& structure : {pinned_sheet(), with_uneven_masses(ring(14, 1.0, 1.0), 0.3)}) {
        const Eigen::MatrixXd b =
            weights(structure, {.lambda = lambda, .form = FilterForm::conserving, .neighbours = neighbours});
        const Eigen::VectorXd spectrum = conserving_spectrum(structure, b);
        EXPECT_GE(spectrum.minCoeff(), -1e-3);
        EXPECT_LE(spectrum.maxCoeff(), 1.0 + 1e-14);
      }
}

// Two neighbours of equal weight turn the mode of alternating signs around: 1/3 - 2/3. What keeps it upright must be
// found where the filter is strongest, whichever of the keys that is.
TEST(ConservingFilter, HasNoNegativeResponseAtAnyTimeHoweverLambdaVaries) {
  const Structure structure = with_uneven_masses(ring(14, 1.0, 1.0), 0.3);
  for (const std::vector<std::pair<double, double>>& keys :
       {std::vector<std::pair<double, double>>{{0.0, 1.0}, {1.0, 0.01}},
        {{0.0, 0.01}, {1.0, 1.0}},
        {{0.5, 2.0}, {1.0, 0.01}, {2.0, 1.0}, {3.0, 0.5}}}) {
    const FilterOptions options{.lambda = 2.0, .form = FilterForm::conserving, .lambda_keys = keys};
    double least = 1.0;
    for (const auto& [time, factor] : keys) {
      const double lowest = conserving_spectrum(structure, weights(structure, options, time)).minCoeff();
      EXPECT_GE(lowest, -1e-3) << "at " << time;
      least = std::min(least, lowest);
    }
    EXPECT_LT(least, 0.01) << "and no weaker than it must be";
  }
}

// All on a line: no inertia about it.
TEST(ConservingFilter, WorksOnAStraightRow) {
  const Structure row = three_in_a_row();
  State state{row.rest_position, seeded_noise(3, 4), 0.0};
  const Eigen::Vector3d before = angular_momentum(row, state);
  test::apply(Filter(row, {.form = FilterForm::conserving}), state.position, 0.0, state.velocity);
  EXPECT_TRUE(state.velocity.allFinite());
  EXPECT_LT((angular_momentum(row, state) - before).norm(), 1e-13);
}

TEST(ConservingFilter, LosesMomentumOnlyThroughThePins) {
  const Structure structure = pinned_sheet();
  const Eigen::MatrixXd b = weights(structure, {.form = FilterForm::conserving});
  for (int i = 0; i < structure.particles(); ++i)
    for (int j = 0; j < structure.particles(); ++j)
      if (!structure.pinned(i) && !structure.pinned(j)) {
        EXPECT_NEAR(structure.mass(i) * b(i, j), structure.mass(j) * b(j, i), 1e-15);
      }
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
