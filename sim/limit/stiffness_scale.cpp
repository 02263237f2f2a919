// Stiffnesses for a wanted k0.
#include "sim/limit/stiffness_scale.h"

#include "base/error.h"
#include "sim/force/spring_force.h"
#include "sim/linear/max_eigenvalue.h"

namespace billow::sim {

void scale_stiffness(Structure& structure, double target) {
  const double k0 = max_eigenvalue(structure, linearise_at_rest(structure).stiffness).value;
  if (!(k0 > 0.0))
    throw InputError(
        "max_eigenvalue cannot be reached: no spring with a stiffness has a particle that is free to move");
  structure.stiffness *= target / k0;
}

}  // namespace billow::sim
