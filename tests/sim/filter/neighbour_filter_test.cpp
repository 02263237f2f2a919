// The paper's filter against its definition: weights by hand, who is a neighbour, lambda in time and space.
#include "sim/filter/filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "tests/support/evaluations.h"
#include "tests/support/filters.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::filtered;
using test::grid;
using test::pinned_sheet;
using test::shaken_state;
using test::three_in_a_row;
using test::varied_options;
using test::weights;

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

TEST(FilterWeights, SumToOneInEveryRowAndAreNeverNegative) {
  const Structure structure = pinned_sheet();
  const State state = shaken_state(structure, 0.03, 0.0);
  for (const FilterOptions& options : varied_options()) {
    const Eigen::MatrixXd b(Filter(structure, options).weights(state.position, 0.0));
    EXPECT_LT((b.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-14);
    EXPECT_GE(b.minCoeff(), 0.0);
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

}  // namespace
}  // namespace billow::sim
