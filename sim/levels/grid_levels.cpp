// Bilinear interpolation between evenly spaced rows and columns.
#include "sim/levels/grid_levels.h"

#include <algorithm>
#include <cmath>

namespace billow::sim {

namespace {

// Whether the structural springs are those between neighbours in a row and in a column, and no others.
bool is_grid(const Structure& structure, const Body& body, int columns) {
  const int rows = body.particles / columns;
  long found = 0;
  for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
    if (structure.kind[static_cast<std::size_t>(s)] != SpringKind::structural) continue;
    const int i = structure.spring(s, 0) - body.first_particle, j = structure.spring(s, 1) - body.first_particle;
    const bool along_row = j == i + 1 && j % columns != 0;
    if (!along_row && j != i + columns) return false;
    ++found;
  }
  return found == 2L * rows * columns - rows - columns;
}

// Evenly spaced nodes from the first place to the last.
AxisInterpolation between(int fine, int nodes) {
  AxisInterpolation axis;
  for (int i = 0; i < fine; ++i) {
    // Whole numbers, so that a node's own place is exact.
    const long scaled = nodes == 1 ? 0 : static_cast<long>(i) * (nodes - 1);
    const long lower = nodes == 1 ? 0 : std::min<long>(scaled / (fine - 1), nodes - 2);
    const double share = nodes == 1 ? 0.0 : static_cast<double>(scaled - lower * (fine - 1)) / (fine - 1);
    axis.lower.push_back(static_cast<int>(lower));
    axis.upper.push_back(std::min(static_cast<int>(lower) + 1, nodes - 1));
    axis.lower_weight.push_back(1.0 - share);
    axis.upper_weight.push_back(share);
  }
  for (int node = 0; node < nodes; ++node) {
    for (std::size_t i = 0; i < axis.lower.size(); ++i)
      for (const auto& [at, weight] :
           {std::pair(axis.lower[i], axis.lower_weight[i]), std::pair(axis.upper[i], axis.upper_weight[i])})
        if (at == node && weight > 0.0) {
          axis.restriction.column.push_back(static_cast<int>(i));
          axis.restriction.weight.push_back(weight);
        }
    axis.restriction.first.push_back(static_cast<int>(axis.restriction.column.size()));
  }
  return axis;
}

int halved(int count) { return count > 2 ? (count + 1) / 2 : count; }

}  // namespace

std::optional<GridShape> grid_shape(const Structure& structure, const Body& body) {
  int columns = 0;
  for (int s = body.first_spring; s < body.first_spring + body.springs; ++s)
    if (structure.kind[static_cast<std::size_t>(s)] == SpringKind::structural)
      columns = std::max(columns, structure.spring(s, 1) - structure.spring(s, 0));
  if (columns < 2 || body.particles % columns != 0 || !is_grid(structure, body, columns)) return std::nullopt;
  return GridShape{body.particles / columns, columns};
}

GridShape coarser(const GridShape& shape) {
  if (shape.rows <= 2 && shape.columns <= 2) return {1, 1};
  return {halved(shape.rows), halved(shape.columns)};
}

GridInterpolation bilinear_interpolation(const GridShape& fine, const GridShape& coarse) {
  GridInterpolation grid{between(fine.columns, coarse.columns), between(fine.rows, coarse.rows), {}};
  grid.pinned.assign(static_cast<std::size_t>(fine.rows), 0);
  return grid;
}

SparseRows rows_of(const GridInterpolation& grid) {
  const AxisInterpolation &along = grid.along, &down = grid.down;
  SparseRows rows;
  for (std::size_t y = 0; y < down.lower.size(); ++y)
    for (std::size_t x = 0; x < along.lower.size(); ++x) {
      const auto add = [&](int row, int column, double weight) {
        if (weight == 0.0) return;
        rows.column.push_back(row * along.nodes() + column);
        rows.weight.push_back(weight);
      };
      add(down.lower[y], along.lower[x], down.lower_weight[y] * along.lower_weight[x]);
      add(down.lower[y], along.upper[x], down.lower_weight[y] * along.upper_weight[x]);
      add(down.upper[y], along.lower[x], down.upper_weight[y] * along.lower_weight[x]);
      add(down.upper[y], along.upper[x], down.upper_weight[y] * along.upper_weight[x]);
      rows.first.push_back(static_cast<int>(rows.column.size()));
    }
  return rows;
}

}  // namespace billow::sim
