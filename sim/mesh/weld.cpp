// Polygons as a file lists them -> a mesh whose vertices are distinct positions. Vertices that differ only in texture
// coordinate or normal are one particle, or a cloth falls apart along its seams.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "base/error.h"
#include "sim/mesh/distinct_positions.h"
#include "sim/mesh/mesh.h"

namespace billow::sim {
namespace {

constexpr double weld_tolerance = 1e-6;  // of the bounding box's diagonal: above float rounding, below any real thread

void check_finite(const PolygonSoup& soup) {
  for (Eigen::Index r = 0; r < soup.position.rows(); ++r)
    if (!soup.position.row(r).allFinite())
      throw InputError("vertex " + std::to_string(r) +
                       " (counted from 0) has a coordinate that is not a finite number; repair the mesh");
  if (!soup.uv.allFinite()) throw InputError("a texture coordinate is not a finite number; repair the mesh");
}

// raw vertex -> number of its distinct position, unused vertices included.
std::vector<int> position_numbers(const PolygonSoup& soup) {
  if (soup.position.rows() == 0) return {};
  const Eigen::Vector3d low = soup.position.colwise().minCoeff();
  const Eigen::Vector3d high = soup.position.colwise().maxCoeff();
  const double diagonal = (high - low).norm();
  if (!std::isfinite(diagonal)) throw InputError("the mesh is too large to measure; scale it down");
  DistinctPositions distinct(low, diagonal > 0.0 ? weld_tolerance * diagonal : 1.0);
  std::vector<int> number(soup.position.rows());
  for (Eigen::Index r = 0; r < soup.position.rows(); ++r) number[r] = distinct.find_or_add(soup.position.row(r));
  return number;
}

// A face as corners of the soup, after corners that fell onto their neighbour were taken out; empty if it collapsed.
std::vector<int> surviving_corners(const Face& face, const std::vector<int>& number) {
  std::vector<int> corner;
  for (int c = 0; c < corner_count(face); ++c)
    if (corner.empty() || number[face[c]] != number[corner.back()]) corner.push_back(face[c]);
  while (corner.size() > 1 && number[corner.front()] == number[corner.back()]) corner.pop_back();
  const bool folded =
      corner.size() == 4 && (number[corner[0]] == number[corner[2]] || number[corner[1]] == number[corner[3]]);
  return corner.size() < 3 || folded ? std::vector<int>{} : corner;
}

// Fills faces and per-corner texture coordinates; faces still hold position numbers, unused ones included.
void add_faces(const PolygonSoup& soup, const std::vector<int>& number, Mesh& mesh) {
  for (std::size_t f = 0; f < soup.face.size(); ++f) {
    const Face& raw = soup.face[f];
    const std::vector<int> corner = surviving_corners(raw, number);
    if (corner.empty()) continue;
    Face face{-1, -1, -1, -1};
    std::array<Eigen::Vector2f, 4> uv;
    uv.fill(Eigen::Vector2f::Zero());
    for (std::size_t c = 0; c < corner.size(); ++c) {
      face[c] = number[corner[c]];
      if (soup.uv.rows() > 0) uv[c] = soup.uv.row(corner[c]);
    }
    mesh.face.push_back(face);
    if (soup.uv.rows() > 0) mesh.uv.push_back(uv);
    if (!soup.face_material.empty()) mesh.face_material.push_back(soup.face_material[f]);
  }
  if (mesh.face.empty()) throw InputError("the mesh has no face with an area; export it with its faces");
}

// position number -> vertex, -1 where no face uses it; renumbers the faces on the way.
std::vector<int> drop_unused(int positions, Mesh& mesh) {
  std::vector<int> vertex(positions, -1);
  for (const Face& face : mesh.face)
    for (int c = 0; c < corner_count(face); ++c) vertex[face[c]] = 0;
  int used = 0;
  for (int& v : vertex)
    if (v == 0) v = used++;
  for (Face& face : mesh.face)
    for (int c = 0; c < corner_count(face); ++c) face[c] = vertex[face[c]];
  mesh.position.resize(used, 3);
  return vertex;
}

void fill_groups(const PolygonSoup& soup, const std::vector<int>& vertex_of_raw, Mesh& mesh) {
  for (const auto& [name, members] : soup.group) {
    std::vector<int> vertices;
    for (const int raw : members)
      if (vertex_of_raw[raw] >= 0) vertices.push_back(vertex_of_raw[raw]);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    if (!vertices.empty()) mesh.group.emplace(name, std::move(vertices));
  }
}

void fill_weights(const PolygonSoup& soup, const std::vector<int>& vertex_of_raw, Mesh& mesh) {
  for (const auto& [name, raw_weight] : soup.weight) {
    Eigen::VectorXf& weight = mesh.weight[name];
    weight.resize(mesh.position.rows());
    for (Eigen::Index r = raw_weight.size() - 1; r >= 0; --r)
      if (vertex_of_raw[r] >= 0) weight(vertex_of_raw[r]) = raw_weight(r);
  }
}

// Positions, colours, groups and weights of the vertices that stayed; a vertex takes those of its first raw copy.
void fill_vertices(const PolygonSoup& soup, const std::vector<int>& vertex_of_raw, Mesh& mesh) {
  const bool coloured = soup.colour.rows() > 0;
  if (coloured) mesh.colour.resize(mesh.position.rows(), 3);
  for (Eigen::Index r = soup.position.rows() - 1; r >= 0; --r) {
    const int vertex = vertex_of_raw[r];
    if (vertex < 0) continue;
    mesh.position.row(vertex) = soup.position.row(r);
    if (coloured) mesh.colour.row(vertex) = soup.colour.row(r);
  }
  fill_groups(soup, vertex_of_raw, mesh);
  fill_weights(soup, vertex_of_raw, mesh);
}

// The layout of raw vertices that are the file's own.
FileLayout raw_layout(const PolygonSoup& soup) {
  FileLayout layout;
  layout.vertex.resize(soup.position.rows());
  std::iota(layout.vertex.begin(), layout.vertex.end(), 0);
  layout.face = soup.face;
  layout.uv = soup.uv;
  if (soup.uv.rows() > 0) layout.uv_corner = soup.face;
  return layout;
}

// The soup's layout, of the mesh's vertices.
FileLayout welded_layout(const PolygonSoup& soup, const std::vector<int>& vertex_of_raw) {
  FileLayout layout = soup.layout.empty() ? raw_layout(soup) : soup.layout;
  std::vector<Eigen::RowVector3d> loose;
  Eigen::Index next_loose = 0;
  for (int& vertex : layout.vertex) {
    const int raw = vertex;
    vertex = raw < 0 ? -1 : vertex_of_raw[raw];
    if (raw < 0)
      loose.push_back(soup.layout.loose.row(next_loose++));
    else if (vertex < 0)
      loose.push_back(soup.position.row(raw));
  }
  layout.loose.resize(static_cast<Eigen::Index>(loose.size()), 3);
  for (std::size_t k = 0; k < loose.size(); ++k) layout.loose.row(static_cast<Eigen::Index>(k)) = loose[k];
  return layout;
}

}  // namespace

Mesh weld(const PolygonSoup& soup) {
  check_finite(soup);
  std::vector<int> number = position_numbers(soup);
  Mesh mesh;
  add_faces(soup, number, mesh);
  const std::vector<int> vertex = drop_unused(static_cast<int>(soup.position.rows()), mesh);
  for (int& n : number) n = vertex[n];
  fill_vertices(soup, number, mesh);
  mesh.layout = welded_layout(soup, number);
  mesh.material = soup.material;
  mesh.linear_colour = soup.linear_colour;
  mesh.ignored = soup.ignored;
  return mesh;
}

}  // namespace billow::sim
