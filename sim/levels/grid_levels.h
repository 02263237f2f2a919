// Levels of a body whose particles are numbered as a grid is.
#pragma once

#include <optional>

#include "sim/levels/level_hierarchy.h"

namespace billow::sim {

/// Particle row * columns + column of a body.
struct GridShape {
  int rows = 0, columns = 0;
};

/// Nothing where the structural springs are not those of a whole grid, numbered row by row.
std::optional<GridShape> grid_shape(const Structure& structure, const Body& body);

/// With about half as many rows and columns.
GridShape coarser(const GridShape& shape);

/// From a coarser grid, whose border it shares, so that fields that are linear along rows and columns are interpolated
/// as they are. No row is said to be pinned.
GridInterpolation bilinear_interpolation(const GridShape& fine, const GridShape& coarse);

/// S of it, a row for each finer place.
SparseRows rows_of(const GridInterpolation& grid);

}  // namespace billow::sim
