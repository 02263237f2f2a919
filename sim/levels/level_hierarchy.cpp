// Level by level, until nothing is left to gather.
#include "sim/levels/level_hierarchy.h"

#include <algorithm>
#include <utility>

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

NodeLevel level_of(SparseRows interpolation, int nodes, const Eigen::VectorXd& finer_mass) {
  NodeLevel level;
  level.restriction = transposed(interpolation, nodes);
  level.interpolation = std::move(interpolation);
  level.mass = product(level.restriction, finer_mass);
  return level;
}

void mark_pinned_rows(GridInterpolation& grid, const std::vector<bool>& present) {
  for (std::size_t i = 0; i < present.size(); ++i)
    if (!present[i]) grid.pinned[i / grid.along.lower.size()] = 1;
}

void add_grid_levels(LevelHierarchy& levels, GridShape shape, const Eigen::VectorXd& mass,
                     const std::vector<bool>& present) {
  while (shape.rows * shape.columns > 1) {
    const GridShape coarse = coarser(shape);
    GridInterpolation grid = bilinear_interpolation(shape, coarse);
    SparseRows rows = rows_of(grid);
    const bool first = levels.level.empty();
    if (first) rows = without_rows(rows, present), mark_pinned_rows(grid, present);
    levels.level.push_back(
        level_of(std::move(rows), coarse.rows * coarse.columns, first ? mass : levels.level.back().mass));
    if (first) levels.level.back().grid = std::move(grid);
    shape = coarse;
  }
}

std::vector<bool> free_particles(const Structure& structure, const Body& body) {
  std::vector<bool> present;
  for (int i = 0; i < body.particles; ++i) present.push_back(!structure.pinned(body.first_particle + i));
  return present;
}

// Of a body's own particles.
Eigen::VectorXd free_masses(const Structure& structure, const Body& body) {
  return free_mass(structure).segment(body.first_particle, body.particles);
}

}  // namespace

LevelHierarchy build_levels(const Structure& structure, const Body& body) {
  LevelHierarchy levels;
  std::vector<bool> present = free_particles(structure, body);
  Eigen::VectorXd mass = free_masses(structure, body);
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
    levels.level.push_back(level_of(std::move(rows), static_cast<int>(graph.size()), mass));
    mass = levels.level.back().mass;
    present.assign(graph.size(), true);
  }
  return levels;
}

namespace {

constexpr std::size_t most_followed = 4;  // [node] as many as bilinear interpolation takes

using Weights = std::vector<std::pair<int, double>>;  // columns, ascending, and what they weigh

// The heaviest, made to sum to 1 again, so that what is the same everywhere stays so.
void keep_heaviest(Weights& row) {
  if (row.size() <= most_followed) return;
  std::stable_sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  row.resize(most_followed);
  std::sort(row.begin(), row.end());
  double sum = 0.0;
  for (const auto& [column, weight] : row) sum += weight;
  for (auto& [column, weight] : row) weight /= sum;
}

Weights product_row(const SparseRows& left, const SparseRows& right, int r, std::vector<double>& sum) {
  Weights row;
  const auto each = [](const SparseRows& rows, int k, const auto& visit) {
    for (int e = rows.first[static_cast<std::size_t>(k)]; e < rows.first[static_cast<std::size_t>(k) + 1]; ++e)
      visit(rows.column[static_cast<std::size_t>(e)], rows.weight[static_cast<std::size_t>(e)]);
  };
  each(left, r, [&](int k, double by) {
    each(right, k, [&](int c, double weight) {
      if (sum[static_cast<std::size_t>(c)] == 0.0) row.emplace_back(c, 0.0);
      sum[static_cast<std::size_t>(c)] += by * weight;
    });
  });
  std::sort(row.begin(), row.end());
  for (auto& [column, weight] : row) weight = std::exchange(sum[static_cast<std::size_t>(column)], 0.0);
  return row;
}

SparseRows short_product(const SparseRows& left, const SparseRows& right, int columns) {
  SparseRows result;
  std::vector<double> sum(static_cast<std::size_t>(columns), 0.0);
  for (int r = 0; r < left.rows(); ++r) {
    Weights row = product_row(left, right, r, sum);
    keep_heaviest(row);
    for (const auto& [column, weight] : row) result.column.push_back(column), result.weight.push_back(weight);
    result.first.push_back(static_cast<int>(result.column.size()));
  }
  return result;
}

NodeLevel coarse_grid(const Structure& structure, const Body& body, const GridShape& shape, const GridShape& coarse) {
  const std::vector<bool> present = free_particles(structure, body);
  GridInterpolation grid = bilinear_interpolation(shape, coarse);
  NodeLevel level =
      level_of(without_rows(rows_of(grid), present), coarse.rows * coarse.columns, free_masses(structure, body));
  mark_pinned_rows(grid, present);
  level.grid = std::move(grid);
  return level;
}

}  // namespace

// A grid's own interpolation is smoother than the product of those between its levels, and shorter.
std::optional<NodeLevel> build_coarse_level(const Structure& structure, const Body& body, int most_nodes) {
  if (most_nodes < 1 || body.particles < 2) return std::nullopt;
  if (const std::optional<GridShape> shape = grid_shape(structure, body)) {
    GridShape coarse = coarser(*shape);
    while (coarse.rows * coarse.columns > most_nodes) coarse = coarser(coarse);
    return coarse_grid(structure, body, *shape, coarse);
  }
  SparseRows product;
  for (const NodeLevel& level : build_levels(structure, body).level) {
    product = product.rows() == 0 ? level.interpolation : short_product(product, level.interpolation, level.nodes());
    if (level.nodes() <= most_nodes) return level_of(std::move(product), level.nodes(), free_masses(structure, body));
  }
  return std::nullopt;
}

}  // namespace billow::sim
