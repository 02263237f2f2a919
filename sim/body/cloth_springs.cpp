// The springs of a cloth from its mesh (docs/method.md). Everything is decided by sorting, so the springs depend on the
// mesh alone, and on a regular grid they are the textbook ones.
#include "sim/body/cloth_springs.h"

#include <algorithm>
#include <string>
#include <utility>

#include "base/error.h"
#include "sim/mesh/mesh_edges.h"

namespace billow::sim {
namespace {

using Pair = std::pair<int, int>;  // first < second

// Bend springs look for partners at 130 degrees or more. The angles of regular meshes stay clear of it, so rounding
// never decides: squares offer 90 and 180, equilateral triangles 120 and 180, split squares 135, five around a vertex
// 144.
constexpr double straight_cosine = -0.643;

// Pairing the edges of one vertex takes the square of their number: a bound keeps a hostile mesh from taking forever.
constexpr std::size_t max_edges_per_vertex = 1024;

Pair ordered(int a, int b) { return std::minmax({a, b}); }

void sort_and_unite(std::vector<Pair>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

std::vector<Pair> without(const std::vector<Pair>& pairs, const std::vector<Pair>& taken) {
  std::vector<Pair> rest;
  std::set_difference(pairs.begin(), pairs.end(), taken.begin(), taken.end(), std::back_inserter(rest));
  return rest;
}

int corner_opposite(const Face& triangle, const Edge& edge) {
  for (int c = 0; c < 3; ++c)
    if (triangle[c] != edge.first && triangle[c] != edge.second) return triangle[c];
  return -1;
}

// Across the edge of two triangles, from one far corner to the other. Where more faces share an edge, each triangle is
// joined with the next one of the file: enough to hold the sheets together, and linear in their number.
void add_across(const Mesh& mesh, const Edge& edge, std::vector<Pair>& shear) {
  for (std::size_t k = 1; k < edge.face.size(); ++k) {
    const Face& left = mesh.face[edge.face[k - 1]];
    const Face& right = mesh.face[edge.face[k]];
    if (corner_count(left) != 3 || corner_count(right) != 3) continue;
    const int a = corner_opposite(left, edge), b = corner_opposite(right, edge);
    if (a >= 0 && b >= 0 && a != b) shear.push_back(ordered(a, b));
  }
}

std::vector<Pair> shear_pairs(const Mesh& mesh, const std::vector<Edge>& edges) {
  std::vector<Pair> shear;
  for (const Face& face : mesh.face) {
    if (corner_count(face) != 4) continue;
    shear.push_back(ordered(face[0], face[2]));
    shear.push_back(ordered(face[1], face[3]));
  }
  for (const Edge& edge : edges) add_across(mesh, edge, shear);
  sort_and_unite(shear);
  return shear;
}

// What surrounds one vertex: its neighbours along links, and the pairs of them that a face already holds in place.
struct Ring {
  std::vector<int> neighbour;
  std::vector<Pair> joined;
};

// `links` are the lines that bending may run along.
std::vector<Ring> rings(const Mesh& mesh, const std::vector<Pair>& links) {
  constexpr std::size_t usual_neighbours = 8;
  std::vector<Ring> ring(mesh.vertices());
  for (Ring& r : ring) r.neighbour.reserve(usual_neighbours), r.joined.reserve(usual_neighbours);
  for (const auto& [first, second] : links) {
    ring[first].neighbour.push_back(second);
    ring[second].neighbour.push_back(first);
  }
  for (const Face& face : mesh.face) {
    const int corners = corner_count(face);
    for (int c = 0; c < corners; ++c)
      ring[face[c]].joined.push_back(ordered(face[(c + corners - 1) % corners], face[(c + 1) % corners]));
  }
  for (Ring& r : ring) sort_and_unite(r.joined);
  return ring;
}

struct StraightPair {
  double cosine;  // of the angle at the vertex between: -1 is dead straight
  Pair pair;
  auto operator<=>(const StraightPair&) const = default;
};

std::vector<StraightPair> straight_pairs(const Mesh& mesh, int vertex, const Ring& ring) {
  std::vector<Eigen::RowVector3d> direction;
  for (const int n : ring.neighbour)
    direction.push_back((mesh.position.row(n) - mesh.position.row(vertex)).normalized());
  std::vector<StraightPair> straight;
  for (std::size_t a = 0; a < direction.size(); ++a)
    for (std::size_t b = a + 1; b < direction.size(); ++b) {
      const double cosine = direction[a].dot(direction[b]);
      const Pair pair = ordered(ring.neighbour[a], ring.neighbour[b]);
      if (cosine <= straight_cosine && !std::binary_search(ring.joined.begin(), ring.joined.end(), pair))
        straight.push_back({cosine, pair});
    }
  std::sort(straight.begin(), straight.end());
  return straight;
}

// The straightest pair first, then the straightest of the neighbours that are left: each neighbour bends with one
// other.
void add_bends(const Mesh& mesh, int vertex, const Ring& ring, std::vector<Pair>& bend) {
  if (ring.neighbour.size() > max_edges_per_vertex)
    throw InputError("vertex " + std::to_string(vertex) + " joins " + std::to_string(ring.neighbour.size()) +
                     " edges, and a cloth can take " + std::to_string(max_edges_per_vertex) +
                     "; remesh it more evenly");
  std::vector<int> taken;
  const auto is_taken = [&](int v) { return std::find(taken.begin(), taken.end(), v) != taken.end(); };
  for (const auto& [cosine, pair] : straight_pairs(mesh, vertex, ring)) {
    if (is_taken(pair.first) || is_taken(pair.second)) continue;
    taken.insert(taken.end(), {pair.first, pair.second});
    bend.push_back(pair);
  }
}

std::vector<Pair> bend_pairs(const Mesh& mesh, const std::vector<Pair>& links) {
  const std::vector<Ring> ring = rings(mesh, links);
  std::vector<Pair> bend;
  for (int vertex = 0; vertex < mesh.vertices(); ++vertex) add_bends(mesh, vertex, ring[vertex], bend);
  sort_and_unite(bend);
  return bend;
}

}  // namespace

std::vector<SpringPair> cloth_springs(const Mesh& mesh, BendLines bend_lines) {
  const std::vector<Edge> edges = distinct_edges(mesh);
  std::vector<Pair> structural;
  for (const Edge& edge : edges) structural.emplace_back(edge.first, edge.second);
  const std::vector<Pair> shear = without(shear_pairs(mesh, edges), structural);
  std::vector<Pair> bend = bend_pairs(mesh, structural);
  if (bend_lines == BendLines::edges_and_diagonals) {
    const std::vector<Pair> diagonal = bend_pairs(mesh, shear);
    bend.insert(bend.end(), diagonal.begin(), diagonal.end());
    sort_and_unite(bend);
  }
  bend = without(without(bend, structural), shear);

  std::vector<SpringPair> springs;
  springs.reserve(structural.size() + shear.size() + bend.size());
  for (const auto& [first, second] : structural) springs.push_back({SpringKind::structural, first, second});
  for (const auto& [first, second] : shear) springs.push_back({SpringKind::shear, first, second});
  for (const auto& [first, second] : bend) springs.push_back({SpringKind::bend, first, second});
  return springs;
}

}  // namespace billow::sim
