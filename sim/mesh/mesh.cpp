// A mesh moved and measured.
#include "sim/mesh/mesh.h"

#include <Eigen/LU>
#include <algorithm>

#include "sim/mesh/mesh_edges.h"

namespace billow::sim {
namespace {

template <class Corners>
void reverse_corners(const Face& face, Corners& of_corner) {
  std::reverse(of_corner.begin(), of_corner.begin() + corner_count(face));
}

// Every face seen from its other side.
void turn_over(Mesh& mesh) {
  for (std::size_t f = 0; f < mesh.uv.size(); ++f) reverse_corners(mesh.face[f], mesh.uv[f]);
  for (Face& face : mesh.face) reverse_corners(Face(face), face);
  for (std::size_t f = 0; f < mesh.layout.uv_corner.size(); ++f)
    reverse_corners(mesh.layout.face[f], mesh.layout.uv_corner[f]);
  for (Face& face : mesh.layout.face) reverse_corners(Face(face), face);
}

}  // namespace

Mesh transformed(const Mesh& mesh, const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation) {
  const auto move = [&](const Eigen::MatrixX3d& position) -> Eigen::MatrixX3d {
    return (position * linear.transpose()).rowwise() + translation.transpose();
  };
  Mesh moved = mesh;
  moved.position = move(mesh.position);
  moved.layout.loose = move(mesh.layout.loose);
  if (linear.determinant() < 0.0) turn_over(moved);
  return moved;
}

double mean_edge_length(const Mesh& mesh) {
  const std::vector<Edge> edges = distinct_edges(mesh);
  double sum = 0.0;
  for (const Edge& edge : edges) sum += (mesh.position.row(edge.second) - mesh.position.row(edge.first)).norm();
  return edges.empty() ? 0.0 : sum / static_cast<double>(edges.size());
}

}  // namespace billow::sim
