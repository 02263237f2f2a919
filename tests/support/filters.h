// What the tests of filters share.
#pragma once

#include <vector>

#include "sim/body/state.h"
#include "sim/filter/filter.h"

namespace billow::test {

constexpr sim::FilterForm all_forms[] = {sim::FilterForm::plain, sim::FilterForm::symmetric,
                                         sim::FilterForm::conserving};

/// Every form, kernel of neighbours, rule of neighbours and kind of distance.
std::vector<sim::FilterOptions> varied_options();

/// Three free particles in a row, springs of 0.5 m: distances 1 and 1 in units of the mean rest length.
sim::Structure three_in_a_row();
/// A sheet of uneven masses, three particles pinned.
sim::Structure pinned_sheet();

/// (n x n) of one application at rest.
Eigen::MatrixXd weights(const sim::Structure& structure, const sim::FilterOptions& options, double time = 0.0);
/// F field.
Eigen::MatrixX3d filtered(const sim::Structure& structure, const sim::FilterOptions& options, Eigen::MatrixX3d field);
/// (3n x 3n) of the whole operator at rest, rigid motions included, particle-major.
Eigen::MatrixXd dense_filter(const sim::Structure& structure, const sim::Filter& filter);
/// (3n) in the same order.
Eigen::VectorXd masses_of_axes(const sim::Structure& structure);

/// apply_and_move and apply_and_kick do, bit for bit, what apply and the arithmetic after it do.
void expect_moves_and_kicks_as_applied(const sim::Filter& filter, const sim::Structure& structure,
                                       const sim::State& state);

}  // namespace billow::test
