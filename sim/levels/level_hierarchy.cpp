// Level by level, until nothing is left to gather.
#include "sim/levels/level_hierarchy.h"

#include <algorithm>

#include "sim/levels/aggregation.h"
#include "sim/levels/grid_levels.h"

namespace billow::sim {

namespace {

SparseRows transposed(const SparseRows& rows, int columns) {
  SparseRows result;
  result.first.assign(static_cast<std::size_t>(columns) + 1, 0);
  for (const int c : rows.column) ++result.first[static_cast<std::size_t>(c) + 1];
  for (std::size_t c = 1; c < result.first.size(); ++c) result.first[c] += result.first[c - 1];
  result.column.resize(rows.column.size());
  result.weight.resize(rows.column.size());
  std::vector<int> next(result.first.begin(), result.first.end() - 1);
  for (int r = 0; r < rows.rows(); ++r)
    for (int e = rows.first[static_cast<std::size_t>(r)]; e < rows.first[static_cast<std::size_t>(r) + 1]; ++e) {
      const auto place =
          static_cast<std::size_t>(next[static_cast<std::size_t>(rows.column[static_cast<std::size_t>(e)])]++);
      result.column[place] = r;
      result.weight[place] = rows.weight[static_cast<std::size_t>(e)];
    }
  return result;
}

// Pinned particles follow nobody.
SparseRows without_rows(const SparseRows& rows, const std::vector<bool>& present) {
  SparseRows result;
  for (int r = 0; r < rows.rows(); ++r) {
    if (present[static_cast<std::size_t>(r)])
      for (int e = rows.first[static_cast<std::size_t>(r)]; e < rows.first[static_cast<std::size_t>(r) + 1]; ++e) {
        result.column.push_back(rows.column[static_cast<std::size_t>(e)]);
        result.weight.push_back(rows.weight[static_cast<std::size_t>(e)]);
      }
    result.first.push_back(static_cast<int>(result.column.size()));
  }
  return result;
}

Eigen::VectorXd product(const SparseRows& rows, const Eigen::VectorXd& x) {
  Eigen::VectorXd result(rows.rows());
  for (int r = 0; r < rows.rows(); ++r) {
    double sum = 0.0;
    for (int e = rows.first[static_cast<std::size_t>(r)]; e < rows.first[static_cast<std::size_t>(r) + 1]; ++e)
      sum += rows.weight[static_cast<std::size_t>(e)] * x(rows.column[static_cast<std::size_t>(e)]);
    result(r) = sum;
  }
  return result;
}

void add_level(LevelHierarchy& levels, const Eigen::VectorXd& finer_mass, SparseRows interpolation, int nodes) {
  NodeLevel level;
  level.restriction = transposed(interpolation, nodes);
  level.interpolation = std::move(interpolation);
  level.mass = product(level.restriction, finer_mass);
  levels.level.push_back(std::move(level));
}

void mark_pinned_rows(GridInterpolation& grid, const std::vector<bool>& present) {
  for (std::size_t i = 0; i < present.size(); ++i)
    if (!present[i]) grid.pinned[i / grid.along.lower.size()] = 1;
}

void add_grid_levels(LevelHierarchy& levels, GridShape shape, const Eigen::VectorXd& mass,
                     const std::vector<bool>& present) {
  while (shape.rows * shape.columns > 1) {
    GridInterpolation grid = bilinear_interpolation(shape);
    SparseRows rows = rows_of(grid);
    const bool first = levels.level.empty();
    if (first) rows = without_rows(rows, present), mark_pinned_rows(grid, present);
    add_level(levels, first ? mass : levels.level.back().mass, std::move(rows), shape.rows * shape.columns);
    if (first) levels.level.back().grid = std::move(grid);
  }
}

}  // namespace

LevelHierarchy build_levels(const Structure& structure, const Body& body) {
  LevelHierarchy levels;
  std::vector<bool> present;
  Eigen::VectorXd mass = structure.mass.segment(body.first_particle, body.particles);
  for (int i = 0; i < body.particles; ++i) {
    present.push_back(!structure.pinned(body.first_particle + i));
    if (!present.back()) mass(i) = 0.0;
  }
  if (const std::optional<GridShape> shape = grid_shape(structure, body)) {
    add_grid_levels(levels, *shape, mass, present);
    return levels;
  }
  Adjacency graph = spring_graph(structure, body);
  for (bool gathers = true; gathers;) {
    const std::size_t nodes = graph.size();
    SparseRows rows = aggregation(graph, present);
    gathers = graph.size() < nodes && !graph.empty();
    if (!gathers) break;
    add_level(levels, mass, std::move(rows), static_cast<int>(graph.size()));
    mass = levels.level.back().mass;
    present.assign(graph.size(), true);
  }
  return levels;
}

}  // namespace billow::sim
