// The vector pass that applies a filter, on the best instruction set that the processor has.
#pragma once

#include <cstddef>

#include "sim/pass/filter_plan.h"
#include "sim/pass/pass_scratch.h"

namespace billow::sim {

/// A field f and where its filtered one goes, columns with one entry per particle of the structure: out = F f, or
/// base + kick_step F f; then moved += move_step out.
struct FilterColumns {
  const double* in[3];
  double* out[3];
  const double* base[3] = {};  // null: none
  double kick_step = 0.0;
  double* moved[3] = {};  // null: none
  double move_step = 0.0;

  void put(int axis, std::ptrdiff_t i, double filtered) const {
    const double value = base[axis] ? base[axis][i] + kick_step * filtered : filtered;
    out[axis][i] = value;
    if (moved[axis]) moved[axis][i] += move_step * value;
  }
};

/// Filters particles [begin, end) of the body; begin is a multiple of band_group, and so is end unless it is the
/// last particle. `weights` are the plan's. Every instruction set gives the same bits.
void filter_bands(const FilterBands& bands, const PlacedWeights& weights, const FilterColumns& columns, int begin,
                  int end, PartScratch& scratch);

/// out = F f on the particles of one block of slices. What else the columns say, put_filtered does when all blocks are
/// done: slices take particles in an order of their own.
void filter_slices(const FilterSlices& slices, const PlacedWeights& weights, const FilterColumns& columns, int block,
                   PartScratch& scratch);

/// As if each particle of [begin, end) had just been filtered, to what its `out` now holds.
void put_filtered(const FilterColumns& columns, int begin, int end);

}  // namespace billow::sim
