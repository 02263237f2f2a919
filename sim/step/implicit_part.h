// What IMEX takes implicitly.
#pragma once

#include "sim/linear/stiffness.h"

namespace billow::sim {

/// matrix += position_weight K_L + velocity_weight C_L: the linear parts of all springs, k (x_j - x_i) and c (v_j -
/// v_i), and friction. The same for every state and axis, and never less than the springs' own K and C.
void add_implicit_part(const Structure& structure, double position_weight, double velocity_weight,
                       StiffnessMatrix& matrix);

}  // namespace billow::sim
