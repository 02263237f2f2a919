// Mesh -> the triangles that are drawn. A corner is a (vertex, uv) pair, so seams split corners and not vertices.
#include "sim/drawn/surface.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "sim/mesh/planar_uv.h"
#include "sim/mesh/split_quad.h"

namespace billow::sim {
namespace {

using FaceUv = std::array<Eigen::Vector2f, 4>;

std::vector<FaceUv> planar_corner_uvs(const Mesh& mesh) {
  const Eigen::MatrixX2f uv = planar_uv(mesh).cast<float>();
  std::vector<FaceUv> corner(mesh.face.size());
  for (std::size_t f = 0; f < mesh.face.size(); ++f)
    for (int c = 0; c < corner_count(mesh.face[f]); ++c) corner[f][c] = uv.row(mesh.face[f][c]);
  return corner;
}

int split_corner(const Mesh& mesh, const Face& quad) {
  std::array<Eigen::Vector3d, 4> corner;
  for (int k = 0; k < 4; ++k) corner[k] = mesh.position.row(quad[k]);
  return sim::split_corner(quad, corner);
}

// Corners in the order in which faces first use them.
class Corners {
 public:
  explicit Corners(int vertices) : first_(static_cast<std::size_t>(vertices), -1) {}

  int number_of(int vertex, const Eigen::Vector2f& uv) {
    for (int corner = first_[vertex]; corner >= 0; corner = next_[corner])
      if (uv_[corner] == uv) return corner;
    const int number = static_cast<int>(point_.size());
    point_.push_back(vertex);
    uv_.push_back(uv);
    next_.push_back(first_[vertex]);
    return first_[vertex] = number;
  }

  void store(Surface& surface) const {
    surface.point = Eigen::VectorXi::Map(point_.data(), static_cast<Eigen::Index>(point_.size()));
    surface.uv.resize(surface.point.size(), 2);
    for (std::size_t c = 0; c < uv_.size(); ++c) surface.uv.row(static_cast<Eigen::Index>(c)) = uv_[c];
  }

 private:
  std::vector<int> first_, next_;  // a vertex's latest corner, and the one of the same vertex before each corner, or -1
  std::vector<int> point_;
  std::vector<Eigen::Vector2f> uv_;
};

void add_triangles(const Mesh& mesh, const Face& face, const std::array<int, 4>& corner,
                   std::vector<Eigen::RowVector3i>& triangles) {
  if (corner_count(face) == 3) {
    triangles.emplace_back(corner[0], corner[1], corner[2]);
    return;
  }
  const int s = split_corner(mesh, face);
  triangles.emplace_back(corner[s], corner[s + 1], corner[s + 2]);
  triangles.emplace_back(corner[s], corner[s + 2], corner[(s + 3) % 4]);
}

// The faces in order, those of each material together.
std::vector<std::size_t> by_material(const Mesh& mesh) {
  std::vector<std::size_t> order(mesh.face.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!mesh.face_material.empty())
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return mesh.face_material[a] < mesh.face_material[b]; });
  return order;
}

}  // namespace

Surface build_surface(const Mesh& mesh) {
  const std::vector<FaceUv> uv = mesh.uv.empty() ? planar_corner_uvs(mesh) : mesh.uv;
  Corners corners(mesh.vertices());
  std::vector<Eigen::RowVector3i> triangles;
  std::vector<int> material;
  for (const std::size_t f : by_material(mesh)) {
    const Face& face = mesh.face[f];
    std::array<int, 4> corner{};
    for (int c = 0; c < corner_count(face); ++c) corner[c] = corners.number_of(face[c], uv[f][c]);
    add_triangles(mesh, face, corner, triangles);
    if (!mesh.face_material.empty()) material.resize(triangles.size(), mesh.face_material[f]);
  }
  Surface surface;
  surface.material = Eigen::VectorXi::Map(material.data(), static_cast<Eigen::Index>(material.size()));
  corners.store(surface);
  surface.triangle.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) surface.triangle.row(static_cast<Eigen::Index>(t)) = triangles[t];
  return surface;
}

}  // namespace billow::sim
