// Zig-zag on grids, Hilbert curve elsewhere.
#include "sim/particle_order.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "sim/planar_uv.h"

namespace billow::sim {

namespace {

// One place (v x 2) per vertex: its first texture coordinate, scaled so that all lie in [0, 1]^2.
Eigen::MatrixX2d flat_positions(const Mesh& mesh) {
  if (mesh.uv.empty()) return planar_uv(mesh);
  Eigen::MatrixX2d flat = Eigen::MatrixX2d::Zero(mesh.vertices(), 2);
  for (std::size_t f = mesh.face.size(); f-- > 0;)
    for (int c = 0; c < corner_count(mesh.face[f]); ++c)
      flat.row(mesh.face[f][c]) = mesh.uv[f][c].cast<double>().transpose();
  const Eigen::RowVector2d low = flat.colwise().minCoeff(), size = flat.colwise().maxCoeff() - low;
  for (int axis = 0; axis < 2; ++axis)
    flat.col(axis) = (flat.col(axis).array() - low(axis)) / std::max(size(axis), 1e-12);
  return flat;
}

using Rows = std::vector<std::vector<int>>;

// Vertices in rows of equal height from the top, each from left to right.
Rows rows_of(const Eigen::MatrixX2d& flat) {
  constexpr double same_row = 1e-4;
  std::vector<int> order(flat.rows());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return flat(a, 1) > flat(b, 1); });
  Rows rows;
  for (const int v : order) {
    if (rows.empty() || flat(rows.back().front(), 1) - flat(v, 1) > same_row) rows.emplace_back();
    rows.back().push_back(v);
  }
  for (auto& row : rows)
    std::stable_sort(row.begin(), row.end(), [&](int a, int b) { return flat(a, 0) < flat(b, 0); });
  return rows;
}

bool is_grid(const Rows& rows) {
  return rows.size() > 1 && rows.front().size() > 1 &&
         std::all_of(rows.begin(), rows.end(), [&](const auto& row) { return row.size() == rows.front().size(); });
}

std::vector<int> boustrophedon(Rows rows) {
  std::vector<int> order;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (r % 2 == 1) std::reverse(rows[r].begin(), rows[r].end());
    order.insert(order.end(), rows[r].begin(), rows[r].end());
  }
  return order;
}

// Distance along the Hilbert curve through a 2^16 x 2^16 lattice: quadrant by quadrant, with each quadrant turned so
// that the curve enters where the last one left.
std::uint64_t hilbert_distance(std::uint32_t x, std::uint32_t y) {
  constexpr std::uint32_t side = 1u << 16;
  std::uint64_t distance = 0;
  for (std::uint32_t s = side / 2; s > 0; s /= 2) {
    const std::uint32_t right = (x & s) ? 1 : 0, up = (y & s) ? 1 : 0;
    distance += std::uint64_t{s} * s * ((3 * right) ^ up);
    if (up) continue;
    if (right) x = side - 1 - x, y = side - 1 - y;
    std::swap(x, y);
  }
  return distance;
}

std::vector<int> hilbert_order(const Eigen::MatrixX2d& flat) {
  std::vector<std::pair<std::uint64_t, int>> keyed(flat.rows());
  const auto lattice = [](double t) { return static_cast<std::uint32_t>(std::lround(t * 65535.0)); };
  for (int v = 0; v < flat.rows(); ++v)
    keyed[v] = {hilbert_distance(lattice(flat(v, 0)), lattice(1.0 - flat(v, 1))), v};
  std::sort(keyed.begin(), keyed.end());
  std::vector<int> order;
  for (const auto& [distance, v] : keyed) order.push_back(v);
  return order;
}

}  // namespace

std::vector<int> zigzag_order(const Mesh& mesh) {
  const Eigen::MatrixX2d flat = flat_positions(mesh);
  Rows rows = rows_of(flat);
  return is_grid(rows) ? boustrophedon(std::move(rows)) : hilbert_order(flat);
}

}  // namespace billow::sim
