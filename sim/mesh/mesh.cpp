// A mesh moved and measured.
#include "sim/mesh/mesh.h"

#include "sim/mesh/mesh_edges.h"

namespace billow::sim {

Mesh transformed(const Mesh& mesh, const Eigen::Matrix3d& rotation, double scale, const Eigen::Vector3d& translation) {
  const auto move = [&](const Eigen::MatrixX3d& position) -> Eigen::MatrixX3d {
    return ((scale * position) * rotation.transpose()).rowwise() + translation.transpose();
  };
  Mesh moved = mesh;
  moved.position = move(mesh.position);
  moved.layout.loose = move(mesh.layout.loose);
  return moved;
}

double mean_edge_length(const Mesh& mesh) {
  const std::vector<Edge> edges = distinct_edges(mesh);
  double sum = 0.0;
  for (const Edge& edge : edges) sum += (mesh.position.row(edge.second) - mesh.position.row(edge.first)).norm();
  return edges.empty() ? 0.0 : sum / static_cast<double>(edges.size());
}

}  // namespace billow::sim
