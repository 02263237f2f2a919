// The vector passes over a spring plan, on the best instruction set that the processor has.
#pragma once

#include "sim/spring_plan.h"
#include "sim/spring_sink.h"

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
void sweep_springs(const SpringBands& bands, const SpringColumns& columns, const SpringSink& sink, int begin, int end);

/// As above, the particles of one block of slices; a particle's sum runs over its springs in the plan's order.
void sweep_springs(const SpringSlices& slices, const SpringColumns& columns, const SpringSink& sink, int block);

}  // namespace billow::sim
