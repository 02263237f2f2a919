// What the conserving form conserves, and that no motion is turned around.
#include "sim/filter/filter.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/random.h"
#include "sim/body/momenta.h"
#include "sim/step/step.h"
#include "tests/support/evaluations.h"
#include "tests/support/filters.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::dense_filter;
using test::grid;
using test::masses_of_axes;
using test::pinned_sheet;
using test::ring;
using test::shaken_state;
using test::three_in_a_row;
using test::weights;
using test::with_uneven_masses;

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

}  // namespace
}  // namespace billow::sim
