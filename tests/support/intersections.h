// Whether surfaces intersect, decided exactly: what contact is checked against.
#pragma once

#include <Eigen/Core>
#include <compare>
#include <vector>

#include "sim/mesh/mesh.h"

namespace billow::test {

/// Triangles in space: what is checked for crossing itself and others. A corner named twice makes a triangle an edge.
struct TriangleSoup {
  Eigen::MatrixX3d position;  // [m] (v x 3)
  Eigen::MatrixX3i triangle;  //     (t x 3)

  /// Appends a surface whose faces count from the first of `p`; quads are split along corners 0-2.
  void add(const Eigen::MatrixX3d& p, const std::vector<sim::Face>& faces);
};

/// An edge that touches or crosses a triangle.
struct Crossing {
  int edge_a, edge_b, triangle;  // the edge's vertices, the lower first

  auto operator<=>(const Crossing&) const = default;
};

/// Every (edge, triangle) pair that shares no vertex and touches or crosses, decided exactly; ascending. Triangles that
/// intersect always make such a pair, but for two that share an edge and are folded flat on one another. Throws
/// std::invalid_argument where a coordinate is not finite, or is not 0 and smaller than 2^-300 or larger than 2^300.
std::vector<Crossing> crossings(const TriangleSoup& soup);

}  // namespace billow::test
