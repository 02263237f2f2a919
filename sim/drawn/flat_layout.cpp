// Texture coordinates -> places in the unit square, and the rows that they form.
#include "sim/drawn/flat_layout.h"

#include <algorithm>
#include <numeric>

#include "sim/mesh/planar_uv.h"

namespace billow::sim {

namespace {

// All corners of a face at its vertices' places.
FlatLayout planar_layout(const Mesh& mesh) {
  FlatLayout layout{planar_uv(mesh), {}};
  for (const Face& face : mesh.face) {
    layout.corner.emplace_back();
    for (int c = 0; c < corner_count(face); ++c) layout.corner.back()[c] = layout.vertex.row(face[c]).transpose();
  }
  return layout;
}

}  // namespace

FlatLayout flat_layout(const Mesh& mesh) {
  if (mesh.uv.empty()) return planar_layout(mesh);
  FlatLayout layout{Eigen::MatrixX2d::Zero(mesh.vertices(), 2), {}};
  layout.corner.resize(mesh.face.size());
  for (std::size_t f = mesh.face.size(); f-- > 0;)
    for (int c = 0; c < corner_count(mesh.face[f]); ++c) {
      layout.corner[f][c] = mesh.uv[f][c].cast<double>();
      layout.vertex.row(mesh.face[f][c]) = layout.corner[f][c].transpose();
    }
  const Eigen::Vector2d low = layout.vertex.colwise().minCoeff();
  const Eigen::Vector2d size = (layout.vertex.colwise().maxCoeff().transpose() - low).cwiseMax(1e-12);
  layout.vertex = (layout.vertex.rowwise() - low.transpose()).array().rowwise() / size.transpose().array();
  for (auto& corners : layout.corner)
    for (Eigen::Vector2d& corner : corners) corner = (corner - low).cwiseQuotient(size);
  return layout;
}

std::vector<std::vector<int>> grid_rows(const Eigen::MatrixX2d& flat) {
  constexpr double same_row = 1e-4;
  std::vector<int> order(flat.rows());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return flat(a, 1) > flat(b, 1); });
  std::vector<std::vector<int>> rows;
  for (const int v : order) {
    if (rows.empty() || flat(rows.back().front(), 1) - flat(v, 1) > same_row) rows.emplace_back();
    rows.back().push_back(v);
  }
  for (auto& row : rows)
    std::stable_sort(row.begin(), row.end(), [&](int a, int b) { return flat(a, 0) < flat(b, 0); });
  const bool grid = rows.size() > 1 && rows.front().size() > 1 &&
                    std::all_of(rows.begin(), rows.end(), [&](auto& row) { return row.size() == rows[0].size(); });
  return grid ? rows : std::vector<std::vector<int>>();
}

}  // namespace billow::sim
