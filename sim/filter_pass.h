// The vector pass that applies a filter, on the best instruction set that the processor has.
#pragma once

#include "sim/filter_plan.h"

namespace billow::sim {

/// Columns of a field before and after, one entry per particle of the structure.
struct FilterColumns {
  const double* in[3];
  double* out[3];
};

/// out = F in on particles [begin, end) of the body; begin is a multiple of band_group, and so is end unless it is the
/// last particle. `weights` are the plan's. Every instruction set gives the same bits.
void filter_bands(const FilterBands& bands, const AlignedVector<double>& weights, const FilterColumns& columns,
                  int begin, int end);

/// As above, on the particles of one block of slices.
void filter_slices(const FilterSlices& slices, const AlignedVector<double>& weights, const FilterColumns& columns,
                   int block);

}  // namespace billow::sim
