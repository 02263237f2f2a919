// Levels against what makes them levels: nodes that stand for all of a body's mass, and for what is smooth exactly.
#include "sim/levels/level_hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "sim/body/cloth.h"
#include "sim/levels/aggregation.h"
#include "sim/levels/grid_levels.h"
#include "tests/support/dense_levels.h"
#include "tests/support/level_bodies.h"
#include "tests/support/mesh_files.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

using test::dense;
using test::fixed_chain;
using test::grid;
using test::interpolations;

LevelHierarchy levels_of(const Structure& structure, int body = 0) {
  return build_levels(structure, structure.body[body]);
}

/// Nodes of every level, the particles first.
std::vector<int> node_counts(const Structure& structure) {
  std::vector<int> count{structure.body[0].particles};
  for (const NodeLevel& level : levels_of(structure).level) count.push_back(level.nodes());
  return count;
}

// [kg] 0 where pinned.
Eigen::VectorXd free_masses(const Structure& structure) {
  return structure.mass.cwiseProduct(structure.inverse_mass.cwiseSign());
}

std::vector<test::LevelBody> bodies() {
  std::vector<test::LevelBody> all = test::all_level_bodies();
  all.push_back({"two sheets", test::as_one_body(merge({test::light_cloth(5, 4, {7}), test::light_cloth(5, 4)}))});
  return all;
}

template <class Check>
void for_every_level(const Check& check) {
  for (const auto& [name, structure] : bodies()) {
    SCOPED_TRACE(name);
    const LevelHierarchy hierarchy = levels_of(structure);
    ASSERT_GE(hierarchy.level.size(), 2u);
    for (std::size_t l = 0; l < hierarchy.level.size(); ++l) {
      SCOPED_TRACE(l + 1);
      check(structure, hierarchy, l);
    }
  }
}

TEST(LevelHierarchy, InterpolatesByWeightsThatAreNotNegativeAndSumToOneButForPins) {
  for_every_level([](const Structure& structure, const LevelHierarchy& hierarchy, std::size_t l) {
    const SparseRows& rows = hierarchy.level[l].interpolation;
    const Eigen::MatrixXd s = dense(rows, hierarchy.level[l].nodes());
    ASSERT_EQ(s.rows(), l == 0 ? structure.particles() : hierarchy.level[l - 1].nodes());
    EXPECT_GE(s.minCoeff(), 0.0);
    for (int i = 0; i < s.rows(); ++i) {
      const bool pinned = l == 0 && structure.pinned(i);
      EXPECT_EQ(rows.first[i + 1] == rows.first[i], pinned) << i;
      EXPECT_NEAR(s.row(i).sum(), pinned ? 0.0 : 1.0, 4e-16) << i;
    }
  });
}

TEST(LevelHierarchy, RestrictsByTheTransposeBitForBit) {
  for_every_level([](const Structure&, const LevelHierarchy& hierarchy, std::size_t l) {
    const NodeLevel& level = hierarchy.level[l];
    EXPECT_EQ(dense(level.restriction, level.interpolation.rows()),
              Eigen::MatrixXd(dense(level.interpolation, level.nodes()).transpose()));
  });
}

TEST(LevelHierarchy, SharesTheFreeMassOutBetweenTheNodesOfEveryLevel) {
  for_every_level([](const Structure& structure, const LevelHierarchy& hierarchy, std::size_t l) {
    const Eigen::VectorXd free = free_masses(structure), &mass = hierarchy.level[l].mass;
    const Eigen::MatrixXd p = interpolations(hierarchy, structure.particles())[l + 1];
    EXPECT_LT((mass - p.transpose() * free).norm(), 1e-14 * mass.norm());
    EXPECT_NEAR(mass.sum(), free.sum(), 1e-14 * free.sum());
  });
}

// Where two parts of a body stand, in particles.
void expect_parts_apart(const Structure& structure, const std::vector<int>& first, const std::vector<int>& second) {
  for (const Eigen::MatrixXd& p : interpolations(levels_of(structure), structure.particles()))
    for (int node = 0; node < p.cols(); ++node) {
      const double of_first = p(first, node).sum(), of_second = p(second, node).sum();
      EXPECT_EQ(std::min(of_first, of_second), 0.0) << "node " << node << " of " << p.cols();
    }
}

std::vector<int> range(int begin, int end) {
  std::vector<int> numbers(static_cast<std::size_t>(end - begin));
  std::iota(numbers.begin(), numbers.end(), begin);
  return numbers;
}

TEST(LevelHierarchy, NeverLetsOneNodeStandForPartsThatNoSpringJoins) {
  const Structure sheets = test::as_one_body(merge({grid({.width = 5, .height = 4}), grid({.width = 5, .height = 6})}));
  expect_parts_apart(sheets, range(0, 20), range(20, 50));
  EXPECT_EQ(node_counts(sheets).back(), 2);
  // A pin in its middle parts a chain as well: pins hold, and pass nothing on.
  Structure chain = fixed_chain({.free_particles = 30});
  chain.inverse_mass(11) = 0.0;
  expect_parts_apart(chain, range(0, 11), range(12, 31));
  EXPECT_EQ(node_counts(chain).back(), 2);
}

// Parts end at different levels: the smaller one's last node must not be lost on the way to the larger one's.
TEST(LevelHierarchy, KeepsAPartThatIsOneNodeUpToTheLastLevel) {
  const Structure structure = test::as_one_body(merge({fixed_chain({.free_particles = 2}), test::ring(40, 1.0, 1.0)}));
  const LevelHierarchy hierarchy = levels_of(structure);
  const std::vector<Eigen::MatrixXd> p = interpolations(hierarchy, structure.particles());
  for (std::size_t l = 1; l < p.size(); ++l) EXPECT_EQ(p[l].middleRows(1, 2).colwise().maxCoeff().sum(), 1.0) << l;
  EXPECT_EQ(hierarchy.level.back().nodes(), 2);
}

TEST(LevelHierarchy, EndsWithOneNodeForEveryBody) {
  for (const auto& [name, structure] : test::all_level_bodies()) {
    SCOPED_TRACE(name);
    const std::vector<int> count = node_counts(structure);
    EXPECT_EQ(count.back(), 1);
    for (std::size_t l = 1; l < count.size(); ++l) EXPECT_LT(count[l], count[l - 1]);
  }
}

TEST(LevelHierarchy, IsEmptyWhereThereIsNothingToGather) {
  Structure one = fixed_chain({.free_particles = 1, .second_wall = false});
  one.inverse_mass(1) = 0.0;
  EXPECT_TRUE(levels_of(one).level.empty()) << "all pinned";
  one.body[0].first_particle = one.body[0].particles = 1;
  one.body[0].springs = 0;
  one.inverse_mass(1) = 1.0;
  EXPECT_TRUE(levels_of(one).level.empty()) << "one particle";
}

TEST(LevelHierarchy, OfTheSecondBodyIsThatOfTheBodyAlone) {
  for (const auto& [name, structure] : bodies()) {
    SCOPED_TRACE(name);
    const LevelHierarchy alone = levels_of(structure),
                         second = levels_of(merge({grid({.width = 3, .height = 3}), structure}), 1);
    ASSERT_EQ(second.level.size(), alone.level.size());
    for (std::size_t l = 0; l < alone.level.size(); ++l) {
      EXPECT_EQ(second.level[l].interpolation.column, alone.level[l].interpolation.column);
      EXPECT_EQ(second.level[l].interpolation.weight, alone.level[l].interpolation.weight);
      EXPECT_EQ(second.level[l].grid.has_value(), alone.level[l].grid.has_value());
    }
  }
}

struct Counts {
  int columns, rows;
  std::vector<int> nodes;
};

TEST(GridLevels, HaveAboutHalfAsManyRowsAndColumnsEach) {
  for (const auto& [columns, rows, nodes] :
       {Counts{5, 5, {25, 9, 4, 1}}, {6, 6, {36, 9, 4, 1}}, {7, 4, {28, 8, 4, 1}}, {2, 11, {22, 12, 6, 4, 1}}}) {
    EXPECT_EQ(node_counts(grid({.width = columns, .height = rows})), nodes);
    EXPECT_EQ(node_counts(grid({.width = rows, .height = columns})), nodes);
  }
}

// Where place `number` of a shape stands, its border at 0 and 1: every level has the same border.
Eigen::Vector2d place(const GridShape& shape, int number) {
  return {static_cast<double>(number % shape.columns) / (shape.columns - 1),
          static_cast<double>(number / shape.columns) / (shape.rows - 1)};
}

Eigen::VectorXd bilinear_field(const GridShape& shape) {
  Eigen::VectorXd field(shape.rows * shape.columns);
  for (int i = 0; i < field.size(); ++i) {
    const Eigen::Vector2d at = place(shape, i);
    field(i) = 1.0 + 2.0 * at.x() - 3.0 * at.y() + 5.0 * at.x() * at.y();
  }
  return field;
}

TEST(GridLevels, ReproduceFieldsThatAreLinearAlongRowsAndColumns) {
  for (const auto& [columns, rows] :
       {std::pair{9, 9}, {8, 8}, {5, 6}, {13, 4}, {5, 15}, {12, 4}, {2, 9}, {10, 2}, {3, 3}, {2, 3}}) {
    SCOPED_TRACE(testing::Message() << columns << " x " << rows);
    GridShape shape{rows, columns};
    const LevelHierarchy hierarchy = levels_of(grid({.width = columns, .height = rows}));
    for (std::size_t l = 0; l + 1 < hierarchy.level.size(); ++l) {
      const Eigen::VectorXd finer = bilinear_field(shape);
      shape = coarser(shape);
      ASSERT_EQ(shape.rows * shape.columns, hierarchy.level[l].nodes());
      const Eigen::MatrixXd s = dense(hierarchy.level[l].interpolation, hierarchy.level[l].nodes());
      EXPECT_LT((s * bilinear_field(shape) - finer).cwiseAbs().maxCoeff(), 1e-14) << l + 1;
    }
  }
}

// The separable form is for the passes; what it leaves out is said row by row.
TEST(GridLevels, SayTheFirstLevelTwiceAndWhichRowsHavePins) {
  const LevelHierarchy hierarchy = levels_of(grid({.width = 6, .height = 5, .pinned = {2, 3, 29}}));
  ASSERT_TRUE(hierarchy.level[0].grid);
  const GridInterpolation& first = *hierarchy.level[0].grid;
  EXPECT_EQ(first.pinned, (std::vector<char>{1, 0, 0, 0, 1}));
  const int nodes = hierarchy.level[0].nodes();
  Eigen::MatrixXd whole = dense(rows_of(first), nodes);
  for (const int pin : {2, 3, 29}) whole.row(pin).setZero();
  EXPECT_EQ(dense(hierarchy.level[0].interpolation, nodes), whole);
  for (const AxisInterpolation& axis : {first.along, first.down}) {
    Eigen::MatrixXd by_places = Eigen::MatrixXd::Zero(axis.nodes(), axis.fine());
    for (int i = 0; i < axis.fine(); ++i) {
      by_places(axis.lower[i], i) += axis.lower_weight[i];
      by_places(axis.upper[i], i) += axis.upper_weight[i];
    }
    EXPECT_EQ(dense(axis.restriction, axis.fine()), by_places);
  }
  for (std::size_t l = 1; l < hierarchy.level.size(); ++l) EXPECT_FALSE(hierarchy.level[l].grid);
}

void expect_shape(const std::optional<GridShape>& shape, int rows, int columns) {
  ASSERT_TRUE(shape);
  EXPECT_EQ(shape->rows, rows);
  EXPECT_EQ(shape->columns, columns);
}

TEST(GridShape, IsFoundInGridsHoweverTheyWereMade) {
  const Structure sheet = grid({.width = 5, .height = 4}), cloth = build_cloth(test::quad_grid(3, 7), {});
  expect_shape(grid_shape(sheet, sheet.body[0]), 4, 5);
  expect_shape(grid_shape(cloth, cloth.body[0]), 7, 3);
  const Structure both = merge({sheet, cloth}), narrow = grid({.width = 2, .height = 3});
  expect_shape(grid_shape(both, both.body[1]), 7, 3);
  expect_shape(grid_shape(narrow, narrow.body[0]), 3, 2);
}

/// The sheet with the first structural spring that leaves `particle` elsewhere.
Structure moved_spring(Structure sheet, int particle, int i, int j) {
  for (int s = 0; s < sheet.springs(); ++s)
    if (sheet.spring(s, 0) == particle && sheet.kind[s] == SpringKind::structural) {
      sheet.spring.row(s) << i, j;
      break;
    }
  return sheet;
}

TEST(GridShape, IsNotFoundInWhatIsNoWholeGrid) {
  const Structure sheet = grid({.width = 5, .height = 4});
  const auto is_grid = [](const Structure& structure) { return grid_shape(structure, structure.body[0]).has_value(); };
  EXPECT_FALSE(is_grid(test::irregular_cloth(5, 4)));
  EXPECT_FALSE(is_grid(test::soft_bar(4)));
  EXPECT_FALSE(is_grid(fixed_chain({.free_particles = 9})));
  EXPECT_FALSE(is_grid(test::as_one_body(merge({sheet, sheet})))) << "two sheets";
  EXPECT_FALSE(is_grid(moved_spring(sheet, 0, 4, 5))) << "from the end of a row to the next row's begin";
  EXPECT_FALSE(is_grid(moved_spring(sheet, 7, 7, 9))) << "two columns on";
  Structure torn = sheet;
  torn.kind[0] = SpringKind::shear;
  EXPECT_FALSE(is_grid(torn)) << "a spring is missing";
}

TEST(SpringGraph, LeavesOutBendsShearsAndPins) {
  const Structure sheet = grid({.width = 3, .height = 3, .pinned = {4}});
  const Adjacency graph = spring_graph(sheet, sheet.body[0]);
  EXPECT_EQ(graph[0], (std::vector<int>{1, 3}));
  EXPECT_EQ(graph[1], (std::vector<int>{0, 2}));
  EXPECT_TRUE(graph[4].empty());
}

// Five in a row: 0 gathers 1, 3 gathers 2 and 4, as each is the first whose neighbours are all ungathered.
TEST(Aggregation, IsTheNeighboursMeanOfFirstComeNeighbourhoods) {
  Adjacency graph{{1}, {0, 2}, {1, 3}, {2, 4}, {3}};
  const Eigen::MatrixXd s = dense(aggregation(graph, std::vector<bool>(5, true)), 2);
  Eigen::MatrixXd expected(5, 2);
  expected << 1, 0, 2.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0, 0, 1, 0, 1;
  EXPECT_LT((s - expected).norm(), 1e-15);
  EXPECT_EQ(graph, (Adjacency{{1}, {0}}));
}

// 0 gathers 1, and 3 its own; 2, between them, was not free when it was its turn.
TEST(Aggregation, LeavesTheRestToWhereMostNeighboursAreOrElseToTheFirst) {
  Adjacency most{{1}, {0, 2}, {1, 4, 5}, {4, 5}, {2, 3}, {2, 3}}, tied{{1}, {0, 2}, {1, 4}, {4}, {2, 3}};
  const Eigen::MatrixXd s = dense(aggregation(most, std::vector<bool>(6, true)), 2),
                        t = dense(aggregation(tied, std::vector<bool>(5, true)), 2);
  EXPECT_EQ(s(2, 0), 1.0 / 4.0) << "1 alone: 2, 4 and 5 are gathered by 3";
  EXPECT_EQ(t(2, 0), 2.0 / 3.0) << "1 and 2 itself";
}

TEST(Aggregation, LeavesOutWhoIsNotThereAndKeepsWhoIsAlone) {
  Adjacency graph{{1}, {0}, {}, {}};
  const SparseRows rows = aggregation(graph, {true, true, false, true});
  EXPECT_EQ(rows.first, (std::vector<int>{0, 1, 2, 2, 3}));
  EXPECT_EQ(rows.column, (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(graph.size(), 2u);
}

}  // namespace
}  // namespace billow::sim
