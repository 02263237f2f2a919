// Counting, edge by edge and face by face.
#include "sim/mesh/mesh_report.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/mesh/boundary.h"
#include "sim/mesh/closed_surface.h"
#include "sim/mesh/mesh_edges.h"
#include "sim/mesh/pieces.h"

namespace billow::sim {
namespace {

constexpr double flat_share = 1e-7;    // twice a flat face's area, of its longest edge squared
constexpr double tiny_share = 1e-3;    // a tiny edge's length, of the mean edge's
constexpr double largest_body = 20.0;  // [m]
constexpr double usual_body = 1.5;     // [m]

Eigen::Vector3d place(const Mesh& mesh, int vertex) { return mesh.position.row(vertex).transpose(); }

Eigen::Vector3d middle_of(const Mesh& mesh, const Face& face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int c = 0; c < corner_count(face); ++c) sum += place(mesh, face[c]);
  return sum / corner_count(face);
}

bool is_seam(const Mesh& mesh, const Edge& edge) {
  if (mesh.uv.empty() || edge.face.size() != 2) return false;
  const auto ends = [&](int f) {
    const Face& face = mesh.face[static_cast<std::size_t>(f)];
    const auto [direction, c] = use_of(face, edge);
    const Eigen::Vector2f one = mesh.uv[static_cast<std::size_t>(f)][c],
                          two = mesh.uv[static_cast<std::size_t>(f)][(c + 1) % corner_count(face)];
    return direction > 0 ? std::pair(one, two) : std::pair(two, one);
  };
  return ends(edge.face[0]) != ends(edge.face[1]);
}

void count_edges(const Mesh& mesh, const std::vector<Edge>& edges, MeshReport& report) {
  report.edges = static_cast<int>(edges.size());
  report.mean_edge = mean_edge_length(mesh);
  report.shortest_edge = INFINITY;
  for (const Edge& edge : edges) {
    const Eigen::Vector3d middle = 0.5 * (place(mesh, edge.first) + place(mesh, edge.second));
    const double length = (place(mesh, edge.second) - place(mesh, edge.first)).norm();
    report.shortest_edge = std::min(report.shortest_edge, length);
    report.longest_edge = std::max(report.longest_edge, length);
    if (length < tiny_share * report.mean_edge) report.tiny_edges.add(middle);
    if (edge.face.size() > 2) report.crowded_edges.add(middle);
    if (is_seam(mesh, edge)) report.seams.add(middle);
    if (edge.face.size() == 2 && use_of(mesh.face[static_cast<std::size_t>(edge.face[0])], edge).direction ==
                                     use_of(mesh.face[static_cast<std::size_t>(edge.face[1])], edge).direction)
      report.turned_edges.add(middle);
  }
}

// Faces with the vertices of an earlier one.
void find_duplicates(const Mesh& mesh, MeshReport& report) {
  std::vector<std::pair<Face, int>> sorted;  // vertices ascending, and which face
  for (const Face& face : mesh.face) {
    sorted.emplace_back(face, static_cast<int>(sorted.size()));
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> later;
  for (std::size_t k = 1; k < sorted.size(); ++k)
    if (sorted[k].first == sorted[k - 1].first) later.push_back(sorted[k].second);
  std::sort(later.begin(), later.end());
  for (const int f : later) report.duplicate_faces.add(middle_of(mesh, mesh.face[static_cast<std::size_t>(f)]));
}

void count_faces(const Mesh& mesh, MeshReport& report) {
  for (const Face& face : mesh.face) {
    ++(corner_count(face) == 3 ? report.triangles : report.quads);
    double longest = 0.0, twice_area = 0.0;
    for (int c = 0; c < corner_count(face); ++c) {
      const Eigen::Vector3d a = place(mesh, face[c]), b = place(mesh, face[(c + 1) % corner_count(face)]);
      longest = std::max(longest, (b - a).norm());
      if (c > 0) twice_area += (a - place(mesh, face[0])).cross(b - place(mesh, face[0])).norm();
    }
    report.area += 0.5 * twice_area;
    if (twice_area <= flat_share * longest * longest) report.flat_faces.add(middle_of(mesh, face));
  }
}

void find_pieces(const Mesh& mesh, MeshReport& report) {
  std::vector<int> piece_of(static_cast<std::size_t>(mesh.vertices()));
  for (const std::vector<int>& piece : pieces(mesh)) {
    for (const int v : piece) piece_of[static_cast<std::size_t>(v)] = static_cast<int>(report.pieces.size());
    report.pieces.push_back(
        {static_cast<int>(piece.size()), 0, mesh.position(piece, Eigen::all).colwise().mean().transpose()});
  }
  for (const Face& face : mesh.face)
    ++report.pieces[static_cast<std::size_t>(piece_of[static_cast<std::size_t>(face[0])])].faces;
  std::stable_sort(report.pieces.begin(), report.pieces.end(),
                   [](const auto& a, const auto& b) { return a.vertices > b.vertices; });
}

void find_borders(const Mesh& mesh, MeshReport& report) {
  for (const std::vector<int>& loop : border_loops(mesh)) {
    MeshReport::Border border{static_cast<int>(loop.size()), 0.0,
                              mesh.position(loop, Eigen::all).colwise().mean().transpose()};
    for (std::size_t k = 0; k < loop.size(); ++k)
      border.length += (place(mesh, loop[(k + 1) % loop.size()]) - place(mesh, loop[k])).norm();
    report.borders.push_back(border);
  }
  std::stable_sort(report.borders.begin(), report.borders.end(),
                   [](const auto& a, const auto& b) { return a.length > b.length; });
}

}  // namespace

int MeshReport::holes() const {
  // A piece that is open has one border to spare; a closed one among several has none.
  const int open_pieces = std::min(static_cast<int>(pieces.size()), static_cast<int>(borders.size()));
  return static_cast<int>(borders.size()) - open_pieces;
}

MeshReport report_of(const Mesh& mesh) {
  MeshReport report;
  const FileLayout layout = file_layout(mesh);
  report.vertices = mesh.vertices();
  report.file_vertices = layout.vertices();
  report.loose_vertices = static_cast<int>(layout.loose.rows());
  report.dropped_faces = static_cast<int>(layout.face.size()) - static_cast<int>(mesh.face.size());
  report.has_uv = !mesh.uv.empty();
  report.box.extend(mesh.position.colwise().minCoeff().transpose());
  report.box.extend(mesh.position.colwise().maxCoeff().transpose());
  count_edges(mesh, distinct_edges(mesh), report);
  count_faces(mesh, report);
  find_duplicates(mesh, report);
  find_pieces(mesh, report);
  find_borders(mesh, report);
  if (report.closed()) report.volume = std::abs(enclosed_volume(mesh));
  return report;
}

std::string_view likely_unit(const Eigen::AlignedBox3d& box) {
  const double size = box.sizes().maxCoeff();
  if (size <= largest_body) return "";
  const auto off = [&](double metres) { return std::abs(std::log(size * metres / usual_body)); };
  return off(0.01) <= off(0.001) ? "cm" : "mm";
}

}  // namespace billow::sim
