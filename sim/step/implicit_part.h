// What IMEX takes implicitly.
#pragma once

#include "sim/linear/stiffness.h"

namespace billow::sim {

/// part += weight K_L, weight C_L: the linear parts of all springs, k (x_j - x_i) and c (v_j - v_i), and friction. The
/// same for every state and axis, and never less than the springs' own K and C.
void add_implicit_part(const Structure& structure, double weight, Linearisation& part);

}  // namespace billow::sim
