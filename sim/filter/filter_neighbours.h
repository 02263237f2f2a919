// Whom a filter takes means over.
#pragma once

#include <Eigen/Core>

#include "sim/filter/filter_options.h"
#include "sim/pass/filter_plan.h"

namespace billow::sim {

/// The neighbours of every particle, ascending, and how far away they are at rest.
struct FilterNeighbourhood {
  NeighbourRows rows;
  Eigen::VectorXd distance;  // [mean rest length of the body] of each entry of the rows
};

/// By springs or within the radius, as `options` say; bodies never mix. `unit` (n) [m] is the mean rest length of each
/// particle's body. A regular cloth's equal distances are equal bit for bit.
FilterNeighbourhood find_neighbours(const Structure& structure, const FilterOptions& options,
                                    const Eigen::VectorXd& unit);

}  // namespace billow::sim
