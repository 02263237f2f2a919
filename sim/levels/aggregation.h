// Levels of any other body.
#pragma once

#include <utility>
#include <vector>

#include "sim/levels/level_hierarchy.h"

namespace billow::sim {

/// Who is joined to whom: row i's neighbours, ascending, without i itself.
using Adjacency = std::vector<std::vector<int>>;

/// Of the free particles of a body, numbered from its first, by all springs but bends and shears; pinned ones join
/// nobody.
Adjacency spring_graph(const Structure& structure, const Body& body);

/// S of the nodes of `graph` from neighbourhoods of them: first each node whose neighbours are all still ungathered
/// gathers these, then those left join the neighbourhood most of their neighbours are in. Nodes with `present` false
/// get an empty row. A row of S is the mean over a node and its neighbours of where these have been gathered. `graph`
/// becomes the neighbourhoods'.
SparseRows aggregation(Adjacency& graph, const std::vector<bool>& present);

}  // namespace billow::sim
