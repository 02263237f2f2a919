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

/// Where a place between 0 and fine - 1 lies between coarse nodes that share its ends.
struct Between {
  int node = 0;        // and the one after it
  double share = 0.0;  // of that one
};

std::vector<Between> places(int fine, int coarse) {
  std::vector<Between> result;
  for (int i = 0; i < fine; ++i) {
    if (coarse == 1) {
      result.push_back({0, 0.0});
      continue;
    }
    // Whole numbers, so that a node's own place is exact.
    const long scaled = static_cast<long>(i) * (coarse - 1);
    const int node = static_cast<int>(std::min<long>(scaled / (fine - 1), coarse - 2));
    result.push_back({node, static_cast<double>(scaled - static_cast<long>(node) * (fine - 1)) / (fine - 1)});
  }
  return result;
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

SparseRows bilinear_interpolation(GridShape& shape) {
  const GridShape coarse =
      shape.rows <= 2 && shape.columns <= 2 ? GridShape{1, 1} : GridShape{halved(shape.rows), halved(shape.columns)};
  const std::vector<Between> down = places(shape.rows, coarse.rows), along = places(shape.columns, coarse.columns);
  SparseRows result;
  for (const Between& y : down)
    for (const Between& x : along) {
      const auto add = [&](int row, int column, double weight) {
        if (weight == 0.0) return;
        result.column.push_back((y.node + row) * coarse.columns + x.node + column);
        result.weight.push_back(weight);
      };
      add(0, 0, (1.0 - y.share) * (1.0 - x.share));
      add(0, 1, (1.0 - y.share) * x.share);
      add(1, 0, y.share * (1.0 - x.share));
      add(1, 1, y.share * x.share);
      result.first.push_back(static_cast<int>(result.column.size()));
    }
  shape = coarse;
  return result;
}

}  // namespace billow::sim
