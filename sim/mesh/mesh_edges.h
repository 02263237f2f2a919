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

/// How a face runs along an edge: 1 from its first vertex to its second, -1 the other way, 0 not at all.
struct EdgeUse {
  int direction = 0;
  int corner = 0;  // of the face, where the edge begins for it
};
EdgeUse use_of(const Face& face, const Edge& edge);

/// Every distinct edge once, ascending by (first, second).
std::vector<Edge> distinct_edges(const Mesh& mesh);

}  // namespace billow::sim
