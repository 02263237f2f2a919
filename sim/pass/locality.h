// Numbering particles so that those that act on each other are near in memory.
#pragma once

#include <utility>
#include <vector>

namespace billow::sim {

/// The order in which a pass should take particles 0 ... particles - 1 whose neighbours are `pairs`: reverse Cuthill &
/// McKee (1969), breadth first from one end of the mesh, so that neighbours are never farther apart than two layers.
/// Empty where that would not at least halve how far apart neighbours are in the numbering they have.
std::vector<int> local_order(const std::vector<std::pair<int, int>>& pairs, int particles);

/// The place of each particle in an order; empty for an empty one.
std::vector<int> ranks(const std::vector<int>& order);

}  // namespace billow::sim
