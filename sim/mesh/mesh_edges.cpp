// The distinct edges of a mesh, by sorting its half-edges: the order depends on nothing but the faces.
#include "sim/mesh/mesh_edges.h"

#include <algorithm>
#include <tuple>

namespace billow::sim {
namespace {

using HalfEdge = std::tuple<int, int, int>;  // smaller vertex, larger vertex, face

std::vector<HalfEdge> sorted_half_edges(const Mesh& mesh) {
  std::vector<HalfEdge> halves;
  halves.reserve(mesh.face.size() * 4);
  for (int f = 0; f < static_cast<int>(mesh.face.size()); ++f) {
    const Face& face = mesh.face[f];
    const int corners = corner_count(face);
    for (int c = 0; c < corners; ++c) {
      const auto [first, second] = std::minmax(face[c], face[(c + 1) % corners]);
      halves.emplace_back(first, second, f);
    }
  }
  std::sort(halves.begin(), halves.end());
  return halves;
}

}  // namespace

EdgeUse use_of(const Face& face, const Edge& edge) {
  const int corners = corner_count(face);
  for (int c = 0; c < corners; ++c) {
    const int next = face[(c + 1) % corners];
    if (face[c] == edge.first && next == edge.second) return {1, c};
    if (face[c] == edge.second && next == edge.first) return {-1, c};
  }
  return {};
}

std::vector<Edge> distinct_edges(const Mesh& mesh) {
  std::vector<Edge> edges;
  for (const auto& [first, second, face] : sorted_half_edges(mesh)) {
    if (edges.empty() || edges.back().first != first || edges.back().second != second)
      edges.push_back({first, second, {}});
    if (edges.back().face.empty() || edges.back().face.back() != face) edges.back().face.push_back(face);
  }
  return edges;
}

}  // namespace billow::sim
