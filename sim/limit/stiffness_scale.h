// A body's stiffness set by its highest frequency instead of in N/m.
#pragma once

#include "sim/body/structure.h"

namespace billow::sim {

/// Scales all stiffnesses of the structure so that lambda_max(M^-1 K) at rest is `target` [1/s^2].
void scale_stiffness(Structure& structure, double target);

}  // namespace billow::sim
