// The passes of levels against themselves: the same bits on every instruction set that this machine has and with any
// number of threads; and the separable ones of grids against those that go entry by entry.
#include "sim/pass/level_pass.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <functional>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "sim/filter/filter.h"
#include "sim/levels/level_hierarchy.h"
#include "tests/support/evaluations.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/level_bodies.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using Eigen::MatrixX3d;
using test::on_every_instruction_set;
using test::shaken_state;

FilterOptions given_levels(std::size_t bodies) {
  return {.kernel = FilterKernel::levels,
          .target = FilterTarget::force,
          .level_shares = std::vector<LevelShares>(bodies, {{0.1, 0.2, 0.3, 0.4}, 0.5})};
}

// All that a filter can do with a field, on one matrix after the other.
std::vector<MatrixX3d> everything(const Structure& structure, const Filter& filter) {
  const State state = shaken_state(structure, 0.01, 1.0);
  const MatrixX3d noise = seeded_noise(structure.particles(), 5);
  MatrixX3d applied = noise, field = noise, moved = state.position, velocity(structure.particles(), 3), kicked;
  FilterScratch scratch;
  filter.apply(state.position, 0.0, applied, scratch);
  filter.apply_and_move(moved, 0.0, field, 0.01, velocity, moved, scratch);
  field = noise;
  filter.apply_and_kick(state.position, 0.0, field, state.velocity, 0.01, kicked, scratch);
  return {applied, moved, velocity, kicked};
}

// Widths around the vectors' sizes; rows with pins and without.
TEST(LevelPass, HasTheSameBitsOnEveryInstructionSet) {
  std::vector<Structure> structures;
  for (const int width : {2, 3, 4, 5, 7, 8, 9, 16, 17, 33}) {
    const Structure sheet = test::with_uneven_masses(test::light_cloth(width, 13), 0.5),
                    held = test::light_cloth(width, 13, {0, width - 1, 5 * width + 1});
    structures.push_back(merge({sheet, held, test::irregular_cloth(width, 13, {1})}));
    structures.push_back(merge({held, test::irregular_cloth(width, 13)}));
  }
  for (const Structure& structure : structures) {
    const Filter filter(structure, given_levels(structure.body.size()));
    const std::vector<MatrixX3d> expected = everything(structure, filter);
    on_every_instruction_set([&] { EXPECT_EQ(everything(structure, filter), expected); });
  }
}

// Enough particles for several threads: with pins, so that moving and kicking are done in the pass, and without.
std::vector<Structure> large_structures() {
  return {test::light_cloth(100, 90, {0, 99, 4550}), test::irregular_cloth(100, 90, {0, 99, 4550}),
          merge({test::light_cloth(128, 70), test::irregular_cloth(128, 70)})};
}

void expect_on_any_number_of_threads(const std::function<std::vector<MatrixX3d>()>& work) {
  const oneapi::tbb::global_control more_than_cores(oneapi::tbb::global_control::max_allowed_parallelism, 4);
  const auto on = [&](int threads) {
    std::vector<MatrixX3d> result;
    oneapi::tbb::task_arena(threads).execute([&] { result = work(); });
    return result;
  };
  const std::vector<MatrixX3d> expected = on(1);
  on_every_instruction_set([&] {
    for (const int threads : {1, 2, 4}) EXPECT_TRUE(on(threads) == expected) << threads << " threads";
  });
}

TEST(LevelPass, HasTheSameBitsWithAnyNumberOfThreads) {
  for (const Structure& structure : large_structures()) {
    for (const Body& body : structure.body) ASSERT_GE(body.particles, least_particles_for_threads);
    const Filter filter(structure, given_levels(structure.body.size()));
    expect_on_any_number_of_threads([&] { return everything(structure, filter); });
  }
}

// Found by eigenvalues, which must not depend on threads either.
TEST(LevelShares, AreTheSameWithAnyNumberOfThreads) {
  const Structure structure = test::light_cloth(100, 90, {0, 99});
  const FilterOptions options{.kernel = FilterKernel::levels, .target = FilterTarget::force, .ratio = 3.0};
  const oneapi::tbb::global_control more_than_cores(oneapi::tbb::global_control::max_allowed_parallelism, 4);
  const auto on = [&](int threads) {
    std::vector<LevelShares> found;
    oneapi::tbb::task_arena(threads).execute([&] { found = Filter(structure, options).options().level_shares; });
    return found.at(0);
  };
  const LevelShares expected = on(1);
  for (const int threads : {2, 4}) {
    EXPECT_EQ(on(threads).gamma, expected.gamma) << threads;
    EXPECT_EQ(on(threads).correction, expected.correction) << threads;
  }
}

/// The columns of a field into another.
FilterColumns columns_between(const MatrixX3d& in, MatrixX3d& out) {
  FilterColumns columns{};
  for (int axis = 0; axis < 3; ++axis) {
    columns.in[axis] = in.col(axis).data();
    columns.out[axis] = out.col(axis).data();
  }
  return columns;
}

using Rows = AlignedVector<double>;

// x, y and z of the rows.
MatrixX3d vectors(const Rows& rows) {
  MatrixX3d result(static_cast<int>(rows.size() / 4), 3);
  for (int r = 0; r < result.rows(); ++r) result.row(r) << rows[4 * r], rows[4 * r + 1], rows[4 * r + 2];
  return result;
}

TEST(GridPass, RestrictsAndInterpolatesWhatTheRowsOfItsMatrixSay) {
  for (const int width : {2, 3, 5, 8, 9, 17}) {
    const Structure sheet = test::with_uneven_masses(test::light_cloth(width, 9, {1, 4 * width}), 0.5);
    const int n = sheet.particles();
    const NodeLevel level = build_levels(sheet, sheet.body[0]).level[0];
    const GridInterpolation& grid = *level.grid;
    const Eigen::VectorXd mass = free_mass(sheet);
    const MatrixX3d field = seeded_noise(n, 3);
    MatrixX3d by_grid(n, 3), by_rows(n, 3);
    Rows fine(4 * n), coarse(4 * level.nodes()), expected(4 * level.nodes());
    PassScratch scratch;
    scratch.prepare();
    put_momenta(columns_between(field, by_rows), 0, mass.data(), fine.data(), 0, n);
    EXPECT_EQ(vectors(fine), MatrixX3d(mass.asDiagonal() * field));
    restrict_rows(level.restriction, fine.data(), expected.data(), 0, level.nodes());
    // In two parts, as two threads would.
    for (const auto& [begin, end] : {std::pair{2, grid.down.nodes()}, {0, 2}})
      restrict_grid(grid, columns_between(field, by_grid), 0, mass.data(), coarse.data(), begin, end, scratch.part(0));
    EXPECT_LT((vectors(coarse) - vectors(expected)).norm(), 1e-14 * vectors(expected).norm()) << width;
    put_interpolated(level.interpolation, expected.data(), 0.3, columns_between(field, by_rows), 0, 0, n);
    for (const auto& [begin, end] : {std::pair{4, 9}, {0, 4}})
      put_interpolated_grid(grid, level.interpolation, expected.data(), 0.3, columns_between(field, by_grid), 0, begin,
                            end, scratch.part(0));
    EXPECT_LT((by_grid - by_rows).norm(), 1e-14 * by_rows.norm()) << width;
    for (const int pin : {1, 4 * width}) EXPECT_EQ(by_grid.row(pin), field.row(pin)) << width;
  }
}

}  // namespace
}  // namespace billow::sim
