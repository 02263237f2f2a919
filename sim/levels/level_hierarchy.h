// A body's particles, and ever fewer nodes that stand for ever larger neighbourhoods of them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/aligned.h"
#include "sim/body/structure.h"

namespace billow::sim {

/// A sparse matrix by rows, as a pass reads it: row r's entries are at first[r] ... first[r + 1] - 1.
struct SparseRows {
  std::vector<int> first{0}, column;
  AlignedVector<double> weight;

  int rows() const { return static_cast<int>(first.size()) - 1; }
};

/// Linear interpolation along one axis of a grid.
struct AxisInterpolation {
  std::vector<int> lower, upper;                     // of each finer place: the nodes it lies between,
  AlignedVector<double> lower_weight, upper_weight;  // and their weights
  SparseRows restriction;                            // the same by nodes

  int fine() const { return static_cast<int>(lower.size()); }
  int nodes() const { return restriction.rows(); }
};

/// Bilinear interpolation: along the rows of a grid whose particle row * along.fine() + column is, and down its
/// columns.
struct GridInterpolation {
  AxisInterpolation along, down;
  std::vector<char> pinned;  // of each row: whether a particle of it is
};

/// One level: its nodes, and how the next finer level's nodes (the body's particles, for the first level) follow them.
struct NodeLevel {
  SparseRows interpolation;               // S: a row for each finer node, >= 0, of sum 1; none for a pinned particle
  SparseRows restriction;                 // its transpose: a row for each node of this level
  std::optional<GridInterpolation> grid;  // the same, on the first level of a grid
  Eigen::VectorXd mass;  // [kg] D = S^T (the finer level's), so that the masses of every level sum to the same
  int nodes() const { return restriction.rows(); }
};

/// Finest first; empty for a body of one particle. No node stands for particles of two parts that no spring joins.
/// Where every node of a part stands for the whole of it, it stays as it is up to the last level.
struct LevelHierarchy {
  std::vector<NodeLevel> level;
};

/// Of one body of `structure`. Particles that springs join row by row, such as a grid's, get bilinear interpolation
/// from rows and columns about twice as far apart; all others are gathered in neighbourhoods, smoothed once by the
/// neighbours' mean (smoothed aggregation: Vanek, Mandel & Brezina 1996).
LevelHierarchy build_levels(const Structure& structure, const Body& body);

/// One level alone: the finest of at most `most_nodes`, interpolated straight to the particles, each of which follows
/// no more than four nodes. Nothing where the body has no such level.
std::optional<NodeLevel> build_coarse_level(const Structure& structure, const Body& body, int most_nodes);

}  // namespace billow::sim
