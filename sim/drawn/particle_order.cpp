// Zig-zag on grids, Hilbert curve elsewhere.
#include "sim/drawn/particle_order.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/drawn/flat_layout.h"

namespace billow::sim {

namespace {

using Rows = std::vector<std::vector<int>>;

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
  const Eigen::MatrixX2d flat = flat_layout(mesh).vertex;
  Rows rows = grid_rows(flat);
  return rows.empty() ? hilbert_order(flat) : boustrophedon(std::move(rows));
}

}  // namespace billow::sim
