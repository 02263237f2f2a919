// Closedness by counting how often faces run along each edge each way; volume by the divergence theorem.
#include "sim/mesh/closed_surface.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "base/error.h"
#include "sim/mesh/boundary.h"
#include "sim/mesh/mesh_edges.h"
#include "sim/mesh/pieces.h"

namespace billow::sim {
namespace {

// A surface that encloses less than this share of its bounding cube is flat but for rounding.
constexpr double least_volume_share = 1e-9;

Eigen::Vector3d corner(const Mesh& mesh, const Face& face, int c) { return mesh.position.row(face[c]); }

// The integral of the normal over a face [m^2]: the corners' cross products around its first one.
Eigen::Vector3d area_vector(const Mesh& mesh, const Face& face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int c = 1; c + 1 < corner_count(face); ++c)
    sum +=
        0.5 * (corner(mesh, face, c) - corner(mesh, face, 0)).cross(corner(mesh, face, c + 1) - corner(mesh, face, 0));
  return sum;
}

std::string shown(const Mesh& mesh, int vertex) {
  const Eigen::RowVector3d place = mesh.position.row(vertex);
  return fmt::format("{} ({:.4g}, {:.4g}, {:.4g})", vertex, place.x(), place.y(), place.z());
}

void require_two_faces(const Mesh& mesh, const Edge& edge, std::ptrdiff_t open_edges) {
  if (edge.face.size() == 1)
    throw InputError(fmt::format(
        "the edge between the vertices {} and {} belongs to 1 face, and a soft body's surface must be closed, with two "
        "faces at every edge; such edges: {}, holes: {}; close the mesh, say 'close_holes: true', or make it a "
        "cloth",
        shown(mesh, edge.first), shown(mesh, edge.second), open_edges, border_loops(mesh).size()));
  if (edge.face.size() != 2)
    throw InputError(
        fmt::format("the edge between the vertices {} and {} belongs to {} faces, and a soft body's surface "
                    "must be closed, with two faces at every edge; mend the mesh, or make it a cloth",
                    shown(mesh, edge.first), shown(mesh, edge.second), edge.face.size()));
  if (use_of(mesh.face[edge.face[0]], edge).direction == use_of(mesh.face[edge.face[1]], edge).direction)
    throw InputError(
        fmt::format("the two faces at the edge between the vertices {} and {} face opposite ways; let all "
                    "faces of the mesh point outwards",
                    shown(mesh, edge.first), shown(mesh, edge.second)));
}

void require_volume(const Mesh& mesh) {
  const Eigen::RowVector3d size = mesh.position.colwise().maxCoeff() - mesh.position.colwise().minCoeff();
  const double volume = std::abs(enclosed_volume(mesh));
  if (!(volume > least_volume_share * std::pow(size.maxCoeff(), 3)))
    throw InputError("the mesh is closed but encloses no volume; give it thickness, or make it a cloth");
}

void require_one_piece(const Mesh& mesh) {
  const std::size_t count = pieces(mesh).size();
  if (count > 1)
    throw InputError(
        fmt::format("the mesh is {} separate surfaces that would fall apart; join them into one, or make "
                    "each a body of its own",
                    count));
}

}  // namespace

double enclosed_volume(const Mesh& mesh) {
  double sum = 0.0;  // of the signed volumes of tetrahedra between the faces and the first vertex
  const Eigen::Vector3d apex = mesh.position.row(0);
  for (const Face& face : mesh.face) sum += area_vector(mesh, face).dot(corner(mesh, face, 0) - apex) / 3.0;
  return sum;
}

Eigen::MatrixX3d outward_normals(const Mesh& mesh) {
  Eigen::MatrixX3d normal = Eigen::MatrixX3d::Zero(mesh.vertices(), 3);
  for (const Face& face : mesh.face)
    for (int c = 0; c < corner_count(face); ++c) normal.row(face[c]) += area_vector(mesh, face).transpose();
  if (enclosed_volume(mesh) < 0.0) normal = -normal;
  return normal.rowwise().normalized();
}

void require_solid(const Mesh& mesh) {
  const std::vector<Edge> edges = distinct_edges(mesh);
  const auto open = std::count_if(edges.begin(), edges.end(), [](const Edge& edge) { return edge.face.size() == 1; });
  for (const Edge& edge : edges) require_two_faces(mesh, edge, open);
  require_one_piece(mesh);
  require_volume(mesh);
}

}  // namespace billow::sim
