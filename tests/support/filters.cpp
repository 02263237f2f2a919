// Filters of small structures.
#include "tests/support/filters.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "tests/support/evaluations.h"
#include "tests/support/structures.h"

namespace billow::test {

using sim::Filter;
using sim::FilterDistances;
using sim::FilterForm;
using sim::FilterKernel;
using sim::FilterNeighbours;
using sim::FilterOptions;
using sim::Structure;

std::vector<FilterOptions> varied_options() {
  std::vector<FilterOptions> list;
  for (const FilterForm form : all_forms)
    for (const FilterKernel kernel : {FilterKernel::exponential, FilterKernel::gaussian})
      for (const FilterNeighbours neighbours : {FilterNeighbours::springs, FilterNeighbours::radius})
        for (const FilterDistances distances : {FilterDistances::rest, FilterDistances::current})
          list.push_back({.kernel = kernel, .form = form, .neighbours = neighbours, .distances = distances});
  return list;
}

Structure three_in_a_row() {
  Structure row = fixed_chain({.free_particles = 2, .rest_length = 0.5, .second_wall = false});
  row.inverse_mass.setOnes();
  return row;
}

Structure pinned_sheet() {
  return with_uneven_masses(grid({.width = 6, .height = 5, .spacing = 0.1, .mass = 0.01, .pinned = {0, 5, 17}}), 0.4);
}

Eigen::MatrixXd weights(const Structure& structure, const FilterOptions& options, double time) {
  return Eigen::MatrixXd(Filter(structure, options).weights(structure.rest_position, time));
}

Eigen::MatrixX3d filtered(const Structure& structure, const FilterOptions& options, Eigen::MatrixX3d field) {
  apply(Filter(structure, options), structure.rest_position, 0.0, field);
  return field;
}

Eigen::MatrixXd dense_filter(const Structure& structure, const Filter& filter) {
  const int n = structure.particles();
  Eigen::MatrixXd matrix(3 * n, 3 * n);
  for (int c = 0; c < 3 * n; ++c) {
    Eigen::MatrixX3d unit = Eigen::MatrixX3d::Zero(n, 3);
    unit(c / 3, c % 3) = 1.0;
    apply(filter, structure.rest_position, 0.0, unit);
    for (int r = 0; r < 3 * n; ++r) matrix(r, c) = unit(r / 3, r % 3);
  }
  return matrix;
}

Eigen::VectorXd masses_of_axes(const Structure& structure) {
  Eigen::VectorXd mass(3 * structure.particles());
  for (int r = 0; r < mass.size(); ++r) mass(r) = structure.mass(r / 3);
  return mass;
}

void expect_moves_and_kicks_as_applied(const Filter& filter, const Structure& structure, const sim::State& state) {
  const Eigen::MatrixX3d noise = seeded_noise(structure.particles(), 5);
  Eigen::MatrixX3d expected = noise, field = noise, moved = state.position, velocity(structure.particles(), 3), kicked;
  apply(filter, state.position, 0.0, expected);
  sim::FilterScratch scratch;
  filter.apply_and_move(moved, 0.0, field, 0.01, velocity, moved, scratch);
  EXPECT_EQ(velocity, expected);
  EXPECT_EQ(moved, (state.position + 0.01 * expected).eval());
  field = noise;
  filter.apply_and_kick(state.position, 0.0, field, state.velocity, 0.01, kicked, scratch);
  EXPECT_EQ(kicked, (state.velocity + 0.01 * expected).eval());
}

}  // namespace billow::test
