// A mesh moved and measured.
#include "sim/mesh/mesh.h"

#include "sim/mesh/mesh_edges.h"

namespace billow::sim {

Mesh transformed(const Mesh& mesh, const Eigen::Matrix3d& rotation, double scale, const Eigen::Vector3d& translation) {
  Mesh moved = mesh;
  moved.position = ((scale * mesh.position) * rotation.transpose()).rowwise() + translation.transpose();
  return moved;
}

double mean_edge_length(const Mesh& mesh) {
  const std::vector<Edge> edges = distinct_edges(mesh);
  double sum = 0.0;
  for (const Edge& edge : edges) sum += (mesh.position.row(edge.second) - mesh.position.row(edge.first)).norm();
  return edges.empty() ? 0.0 : sum / static_cast<double>(edges.size());
}

}  // namespace billow::sim
