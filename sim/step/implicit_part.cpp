// Linear parts.
#include "sim/step/implicit_part.h"

#include "sim/force/fluid_friction.h"

namespace billow::sim {

void add_implicit_part(const Structure& structure, double position_weight, double velocity_weight,
                       StiffnessMatrix& matrix) {
  for (int s = 0; s < structure.springs(); ++s)
    matrix.add_spring(s, Eigen::Vector3d::Zero(),
                      position_weight * structure.stiffness(s) + velocity_weight * structure.damping(s), 0.0);
  add_friction(structure, velocity_weight, matrix);
}

}  // namespace billow::sim
