// The vector passes that take fields between particles and the nodes of levels, on the best instruction set that the
// processor has.
#pragma once

#include "sim/levels/level_hierarchy.h"
#include "sim/pass/filter_pass.h"

namespace billow::sim {

/// Every pass is over [begin, end) of what it writes; every instruction set gives the same bits. Nodes' vectors are
/// rows of x, y, z and a number that means nothing, on cache lines of 64 bytes.

/// row[i] = mass[i] x of the particles from `first_particle` on, x the columns' field.
void put_momenta(const FilterColumns& columns, int first_particle, const double* mass, double* row, int begin, int end);

/// coarse[r] = sum of the restriction's weights x fine.
void restrict_rows(const SparseRows& restriction, const double* fine, double* coarse, int begin, int end);

/// fine[r] = share[r] fine[r] + sum of the interpolation's weights x coarse. `coarse` null: none.
void interpolate_rows(const SparseRows& interpolation, const double* coarse, const double* share, double* fine,
                      int begin, int end);

/// To the columns' `out`, as FilterColumns::put: share x in + sum of the interpolation's weights x coarse; `in` itself
/// for particles whose row is empty.
void put_interpolated(const SparseRows& interpolation, const double* coarse, double share, const FilterColumns& columns,
                      int first_particle, int begin, int end);

/// put_momenta and restrict_rows in one, on a grid: the nodes of rows [begin, end) of the coarser one. Sums are taken
/// down the columns first.
void restrict_grid(const GridInterpolation& grid, const FilterColumns& columns, int first_particle, const double* mass,
                   double* coarse, int begin, int end, PartScratch& scratch);

/// put_interpolated on a grid's particles of rows [begin, end), along the rows first. Rows with pinned particles are
/// left to put_interpolated, by `interpolation`.
void put_interpolated_grid(const GridInterpolation& grid, const SparseRows& interpolation, const double* coarse,
                           double share, const FilterColumns& columns, int first_particle, int begin, int end,
                           PartScratch& scratch);

}  // namespace billow::sim
