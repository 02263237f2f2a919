// Corners of faces that share a vertex are joined across smooth edges; what hangs together is one vertex of the result.
#include "sim/mesh/creases.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "sim/mesh/disjoint_sets.h"
#include "sim/mesh/mesh_edges.h"

namespace billow::sim {

namespace {

Eigen::Vector3d unit_normal(const Mesh& mesh, const Face& face) {
  const auto at = [&](int c) -> Eigen::Vector3d { return mesh.position.row(face[c]); };
  const int last = corner_count(face) - 1;
  return (at(last - 1) - at(0)).cross(at(last) - at(last == 3 ? 1 : 0)).normalized();  // a quad's by its diagonals
}

int corner_at(const Face& face, int vertex) {
  return static_cast<int>(std::find(face.begin(), face.end(), vertex) - face.begin());
}

/// Number 4 f + c of a corner of face f -> the smallest number that hangs together with it.
std::vector<int> joined_corners(const Mesh& mesh, double angle) {
  DisjointSets sets(static_cast<int>(4 * mesh.face.size()));
  for (const Edge& edge : distinct_edges(mesh)) {
    if (edge.face.size() != 2) continue;
    const Face &one = mesh.face[edge.face[0]], &other = mesh.face[edge.face[1]];
    if (!(unit_normal(mesh, one).dot(unit_normal(mesh, other)) >= std::cos(angle))) continue;
    for (const int vertex : {edge.first, edge.second})
      sets.join(4 * edge.face[0] + corner_at(one, vertex), 4 * edge.face[1] + corner_at(other, vertex));
  }
  std::vector<int> joined(4 * mesh.face.size());
  for (std::size_t k = 0; k < joined.size(); ++k) joined[k] = sets.root(static_cast<int>(k));
  return joined;
}

}  // namespace

Mesh split_at_creases(const Mesh& mesh, double angle) {
  const std::vector<int> joined = joined_corners(mesh, angle);
  std::map<int, int> vertex;  // joined corners -> vertex of the result
  std::vector<int> source;    // vertex of the result -> vertex of the mesh
  Mesh split;
  split.face = mesh.face;
  split.uv = mesh.uv;
  split.face_material = mesh.face_material;
  for (std::size_t f = 0; f < mesh.face.size(); ++f)
    for (int c = 0; c < corner_count(mesh.face[f]); ++c) {
      const auto [entry, fresh] = vertex.try_emplace(joined[4 * f + c], static_cast<int>(source.size()));
      if (fresh) source.push_back(mesh.face[f][c]);
      split.face[f][c] = entry->second;
    }
  split.position = mesh.position(source, Eigen::all);
  if (mesh.colour.rows() > 0) split.colour = mesh.colour(source, Eigen::all);
  split.linear_colour = mesh.linear_colour;
  return split;
}

}  // namespace billow::sim
