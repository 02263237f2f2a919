// Linear parts.
#include "sim/step/implicit_part.h"

#include "sim/force/fluid_friction.h"

namespace billow::sim {

void add_implicit_part(const Structure& structure, double weight, Linearisation& part) {
  for (int s = 0; s < structure.springs(); ++s) {
    part.stiffness.add_spring(s, Eigen::Vector3d::Zero(), weight * structure.stiffness(s), 0.0);
    part.damping.add_spring(s, Eigen::Vector3d::Zero(), weight * structure.damping(s), 0.0);
  }
  add_friction(structure, weight, part.damping);
}

}  // namespace billow::sim
