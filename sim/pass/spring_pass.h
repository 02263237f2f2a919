// The vector passes over a spring plan, on the best instruction set that the processor has.
#pragma once

#include "sim/pass/pass_scratch.h"
#include "sim/pass/spring_plan.h"
#include "sim/pass/spring_sink.h"

namespace billow::sim {

/// Columns of the arrays that a spring pass reads, one entry per particle of the structure.
struct SpringColumns {
  const double* position[3];  // [m]
  const double* velocity[3];  // [m/s] read where springs are damped
};

/// Puts the springs' forces and damping on particles [begin, end) of the body into `sink`, whose columns are the
/// structure's; begin is a multiple of band_group, and so is end unless it is the last particle. Particles' sums run
/// over the strides: first the springs that start there, then those that end there. Every instruction set gives the
/// same bits.
void sweep_springs(const SpringBands& bands, const SpringColumns& columns, const SpringSink& sink, int begin, int end,
                   PartScratch& scratch);

/// sum (three columns, one entry per particle of the body) = the springs' forces and damping on the particles of slices
/// [begin, end). A particle's sum runs over its springs in the order of the slices, whatever begin and end are.
void sum_springs(const SpringSlices& slices, const SpringColumns& columns, double* const sum[3], int begin, int end,
                 PartScratch& scratch);

/// Puts sums, columns like the sink's, of particles [begin, end) into `sink`; `sum` may be its `out`.
void put_sums(const SpringSink& sink, const double* const sum[3], int begin, int end);

}  // namespace billow::sim
