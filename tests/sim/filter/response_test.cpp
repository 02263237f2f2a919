// Responses against closed forms: waves on rings, where every filter's is known, and along chains.
#include "sim/filter/response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/level_bodies.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using Eigen::MatrixX3d;
using std::numbers::pi;

FilterOptions levels(double ratio) {
  return {.kernel = FilterKernel::levels, .target = FilterTarget::force, .ratio = ratio};
}

FilteredShare share_of(const Structure& structure, const FilterOptions& options, const MatrixX3d& field) {
  FilterScratch scratch;
  return filtered_share(structure, Filter(structure, options), structure.rest_position, 0.0, field, scratch);
}

// Neighbours at distance 1 on both sides: (1 + 2 e^-lambda cos k) / (1 + 2 e^-lambda), even below 0.
TEST(FilteredShare, OfAWaveOnARingIsTheExponentialFiltersClosedForm) {
  constexpr int n = 24;
  const Structure ring = test::ring(n, 0.3, 70.0);
  for (const double lambda : {0.4, 1.0, 3.0})
    for (const int waves : {0, 1, 5, n / 2}) {
      MatrixX3d field = MatrixX3d::Zero(n, 3);
      for (int i = 0; i < n; ++i) field.row(i).setConstant(std::cos(2.0 * pi * waves * i / n));
      const double e = std::exp(-lambda);
      const double expected = (1.0 + 2.0 * e * std::cos(2.0 * pi * waves / n)) / (1.0 + 2.0 * e);
      EXPECT_NEAR(share_of(ring, {.lambda = lambda}, field).response(), expected, 1e-14) << lambda << ", " << waves;
      const FilteredShare twice = share_of(ring, {.lambda = lambda, .passes = 2}, field);
      EXPECT_NEAR(twice.response(), expected * expected, 1e-14) << "two passes";
    }
}

TEST(FilteredShare, OfAConstantFieldIsAllOfIt) {
  for (const auto& [name, structure] : test::free_level_bodies()) {
    SCOPED_TRACE(name);
    const MatrixX3d constant = Eigen::RowVector3d(1.0, -2.0, 0.5).replicate(structure.particles(), 1);
    for (const FilterOptions& options : {FilterOptions{}, FilterOptions{.form = FilterForm::conserving}, levels(4.0)}) {
      const FilteredShare share = share_of(structure, options, constant);
      EXPECT_NEAR(share.response(), 1.0, 1e-13);
      EXPECT_NEAR(share.whole, 5.25 * structure.mass.sum(), 1e-12 * share.whole);
    }
  }
}

// Pins keep their rows, whatever these are: nothing of them was filtered.
TEST(FilteredShare, CountsFreeParticlesAloneAndIsOneWhereThereIsNothing) {
  const Structure sheet = test::light_cloth(5, 4, {0, 7});
  MatrixX3d field = MatrixX3d::Zero(20, 3);
  field.row(7) << 1.0, 2.0, 3.0;
  const FilteredShare share = share_of(sheet, levels(2.0), field);
  EXPECT_EQ(share.whole, 0.0);
  EXPECT_EQ(share.response(), 1.0);
}

// v_i = cos(p pi i / N), N = n - 1: (v . L v) / (v . v) = 4 k sin^2(p pi / 2 N) N / (N + 2); of the shortest, whose
// squares are all 1, N / (N + 1).
TEST(WaveResponses, HaveTheFrequenciesOfALongChain) {
  constexpr int n = 101, half_waves[] = {1, 10, n - 1};
  constexpr double k = 70.0, m = 0.3, last = n - 1;
  Structure chain =
      test::fixed_chain({.free_particles = n - 1, .mass = m, .stiffness = k, .rest_length = 0.2, .second_wall = false});
  chain.inverse_mass(0) = 1.0 / m;
  const std::vector<WaveResponse> waves = wave_responses(chain, chain.body[0], nullptr, 3);
  ASSERT_EQ(waves.size(), 3u);
  for (int w = 0; w < 3; ++w) {
    const double ends = last / (w < 2 ? last + 2.0 : last + 1.0), sine = std::sin(0.5 * pi * half_waves[w] / last);
    EXPECT_NEAR(waves[w].frequency, std::sqrt(4.0 * k / m * ends) * sine / (2.0 * pi), 1e-9) << w;
    EXPECT_EQ(waves[w].response, 1.0) << "no filter";
  }
}

// In the inside of a long chain, which is nearly all of it, the exponential filter's closed form again.
TEST(WaveResponses, OfTheExponentialFilterAreItsClosedFormButForTheEnds) {
  constexpr int n = 201;
  Structure chain = test::fixed_chain({.free_particles = n - 1, .rest_length = 0.2, .second_wall = false});
  chain.inverse_mass(0) = 1.0;
  const Filter filter(chain, {});
  const std::vector<WaveResponse> waves = wave_responses(chain, chain.body[0], &filter, 9);
  ASSERT_EQ(waves.size(), 9u);
  const double e = std::exp(-1.0);
  for (int w = 0; w < 9; ++w) {
    const double angle = pi / (n - 1) * std::pow(n - 1, w / 8.0);
    EXPECT_NEAR(waves[w].response, (1.0 + 2.0 * e * std::cos(angle)) / (1.0 + 2.0 * e), 0.01) << w;
  }
}

// Von Neumann's picture of levels: long waves pass, short ones are left with little, nothing is turned around.
TEST(WaveResponses, OfLevelsFallFromNearlyOneTowardsTheParticlesShare) {
  for (const Structure& structure : {test::light_cloth(24, 24), test::irregular_cloth(24, 24)}) {
    const Filter filter(structure, levels(5.0));
    const std::vector<WaveResponse> waves = wave_responses(structure, structure.body[0], &filter, 12);
    ASSERT_EQ(waves.size(), 12u);
    for (std::size_t w = 0; w < waves.size(); ++w) {
      EXPECT_GT(waves[w].response, 0.0) << w;
      EXPECT_LE(waves[w].response, 1.0 + 1e-12) << w;
    }
    EXPECT_TRUE(std::is_sorted(waves.begin(), waves.begin() + 9,
                               [](const WaveResponse& a, const WaveResponse& b) { return a.frequency < b.frequency; }));
    EXPECT_GT(waves.front().response, 0.9);
    EXPECT_LT(waves.back().response, 0.2);
    EXPECT_GE(waves.back().response, filter.options().level_shares[0].gamma[0]);
  }
}

// Of each body by its own size and masses, the others at rest; all pinned has no waves.
TEST(WaveResponses, AreThoseOfTheBodyAlone) {
  const Structure small = test::light_cloth(6, 5), large = test::light_cloth(12, 11, {0});
  Structure held = test::light_cloth(3, 3);
  held.inverse_mass.setZero();
  const Structure all = merge({small, large, held});
  const Filter filter(all, levels(3.0));
  FilterOptions of_large = levels(3.0);
  of_large.level_shares = {filter.options().level_shares[1]};
  const Filter alone(large, of_large);
  const std::vector<WaveResponse> waves = wave_responses(all, all.body[1], &filter, 4),
                                  expected = wave_responses(large, large.body[0], &alone, 4);
  ASSERT_EQ(waves.size(), expected.size());
  for (std::size_t w = 0; w < waves.size(); ++w) {
    EXPECT_NEAR(waves[w].frequency, expected[w].frequency, 1e-12 * expected[w].frequency) << w;
    EXPECT_NEAR(waves[w].response, expected[w].response, 1e-12) << w;
  }
  EXPECT_TRUE(wave_responses(all, all.body[2], &filter, 4).empty());
}

}  // namespace
}  // namespace billow::sim
