// Which particles a cell of the picture is made of.
#include "sim/drawn/grid_sampling.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "sim/drawn/flat_layout.h"

namespace billow::sim {

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

void set_weights(GridSampling& grid, int vertices, const Triplets& triplets) {
  grid.weight.resize(grid.width * grid.height, vertices);
  grid.weight.setFromTriplets(triplets.begin(), triplets.end());
}

// Whether every vertex stands within a tenth of a cell of its place on the grid: a transform takes cells to be evenly
// spaced, which rows of equal length need not be.
bool is_even(const std::vector<std::vector<int>>& rows, const Eigen::MatrixX2d& place) {
  const auto down = static_cast<double>(rows.size() - 1), across = static_cast<double>(rows[0].size() - 1);
  for (std::size_t y = 0; y < rows.size(); ++y)
    for (std::size_t x = 0; x < rows[y].size(); ++x)
      if (std::abs(place(rows[y][x], 0) * across - static_cast<double>(x)) > 0.1 ||
          std::abs((1.0 - place(rows[y][x], 1)) * down - static_cast<double>(y)) > 0.1)
        return false;
  return true;
}

GridSampling regular_sampling(const std::vector<std::vector<int>>& rows, int vertices) {
  GridSampling grid{static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), {}, {}};
  Triplets triplets;
  for (const std::vector<int>& row : rows)
    for (const int vertex : row) triplets.emplace_back(static_cast<int>(triplets.size()), vertex, 1.0);
  grid.covered.assign(triplets.size(), true);
  set_weights(grid, vertices, triplets);
  return grid;
}

/// Fills cells from one triangle after another; the first that holds a cell's place keeps it. Cells stand where the
/// particles of a regular grid of that size would, border included: the same motion then has the same spectrum.
class Rasteriser {
 public:
  explicit Rasteriser(int side) : grid_{side, side, {}, std::vector<bool>(static_cast<std::size_t>(side) * side)} {}

  void add(const std::array<Eigen::Vector2d, 3>& place, const std::array<int, 3>& vertex) {
    Eigen::Matrix2d edges;
    edges << place[1] - place[0], place[2] - place[0];
    if (std::abs(edges.determinant()) < 1e-14) return;
    const Eigen::Matrix2d inverse = edges.inverse();
    const auto [low_x, high_x] = cells(place, 0);
    const auto [low_y, high_y] = cells(place, 1);
    for (int y = low_y; y <= high_y; ++y)
      for (int x = low_x; x <= high_x; ++x) add_cell(x, y, inverse * (place_of(x, y) - place[0]), vertex);
  }

  GridSampling finish(int vertices) {
    set_weights(grid_, vertices, triplets_);
    return std::move(grid_);
  }

 private:
  // Rows count downwards, v upwards.
  Eigen::Vector2d place_of(int x, int y) const {
    return {static_cast<double>(x) / (grid_.width - 1), 1.0 - static_cast<double>(y) / (grid_.height - 1)};
  }

  // Cells that the triangle's extent along an axis may touch; for v counted from the top.
  std::pair<int, int> cells(const std::array<Eigen::Vector2d, 3>& place, int axis) const {
    const auto [low, high] = std::minmax({place[0](axis), place[1](axis), place[2](axis)});
    const int side = grid_.width;
    const int first = std::clamp(static_cast<int>(std::floor(low * (side - 1))), 0, side - 1);
    const int last = std::clamp(static_cast<int>(std::ceil(high * (side - 1))), 0, side - 1);
    return axis == 0 ? std::pair(first, last) : std::pair(side - 1 - last, side - 1 - first);
  }

  void add_cell(int x, int y, const Eigen::Vector2d& t, const std::array<int, 3>& vertex) {
    constexpr double edge = -1e-4;  // of the triangle: a file's rounding must not part the border from the cloth
    const int cell = y * grid_.width + x;
    if (grid_.covered[cell] || t.x() < edge || t.y() < edge || t.x() + t.y() > 1.0 - edge) return;
    grid_.covered[cell] = true;
    triplets_.emplace_back(cell, vertex[0], 1.0 - t.x() - t.y());
    triplets_.emplace_back(cell, vertex[1], t.x());
    triplets_.emplace_back(cell, vertex[2], t.y());
  }

  GridSampling grid_;
  Triplets triplets_;
};

GridSampling interpolated_sampling(const Mesh& mesh, const FlatLayout& layout) {
  Rasteriser rasteriser(std::max(2, static_cast<int>(std::lround(std::sqrt(mesh.vertices())))));
  for (std::size_t f = 0; f < mesh.face.size(); ++f)
    for (int c = 1; c + 1 < corner_count(mesh.face[f]); ++c)
      rasteriser.add({layout.corner[f][0], layout.corner[f][c], layout.corner[f][c + 1]},
                     {mesh.face[f][0], mesh.face[f][c], mesh.face[f][c + 1]});
  return rasteriser.finish(mesh.vertices());
}

}  // namespace

GridSampling grid_sampling(const Mesh& mesh) {
  const FlatLayout layout = flat_layout(mesh);
  const std::vector<std::vector<int>> rows = grid_rows(layout.vertex);
  const bool even = !rows.empty() && is_even(rows, layout.vertex);
  return even ? regular_sampling(rows, mesh.vertices()) : interpolated_sampling(mesh, layout);
}

Eigen::MatrixX3d GridSampling::sample(const Eigen::MatrixX3d& values) const {
  Eigen::MatrixX3d cells = weight * values;
  const auto inside = std::count(covered.begin(), covered.end(), true);
  if (inside == 0 || inside == static_cast<std::ptrdiff_t>(covered.size())) return cells;
  const Eigen::RowVector3d mean = cells.colwise().sum() / static_cast<double>(inside);
  for (std::size_t cell = 0; cell < covered.size(); ++cell)
    if (!covered[cell]) cells.row(static_cast<Eigen::Index>(cell)) = mean;
  return cells;
}

}  // namespace billow::sim
