// The vector passes over a spring plan, on the best instruction set that the processor has.
#pragma once

#include "sim/spring_plan.h"

namespace billow::sim {

/// Columns of the arrays that a spring pass reads and adds to, one entry per particle of the structure.
struct SpringColumns {
  const double* position[3];  // [m]
  const double* velocity[3];  // [m/s] read where springs are damped
  double* force[3];           // [N]
};

/// force += the springs' forces and damping on particles [begin, end) of the body; begin is a multiple of band_group,
/// and so is end unless it is the last particle. Particles' sums run over the strides: first the springs that start
/// there, then those that end there. Every instruction set gives the same bits.
void add_band_forces(const SpringBands& bands, const SpringColumns& columns, int begin, int end);

/// As above, on the particles of one block of slices; sums run over springs in the plan's order.
void add_slice_forces(const SpringSlices& slices, const SpringColumns& columns, int block);

}  // namespace billow::sim
