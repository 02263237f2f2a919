// The distinct edges of a mesh and the faces that meet on them: what springs and edge lengths are made from.
#pragma once

#include <vector>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// One undirected edge, first < second.
struct Edge {
  int first, second;
  std::vector<int> face;  // faces that meet here, ascending: 1 on a border, 2 inside, more where sheets join
};

/// Every distinct edge once, ascending by (first, second).
std::vector<Edge> distinct_edges(const Mesh& mesh);

}  // namespace billow::sim
