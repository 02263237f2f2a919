// Lift.
#include "sim/force/buoyancy.h"

namespace billow::sim {

void Buoyancy::add_force(const State&, Eigen::MatrixX3d& force) const {
  for (int axis = 0; axis < 3; ++axis)
    force.col(axis).segment(body_.first_particle, body_.particles) +=
        lift_(axis) * structure_.mass.segment(body_.first_particle, body_.particles);
}

double Buoyancy::energy(const State& state) const {
  return -structure_.mass.segment(body_.first_particle, body_.particles)
              .dot(state.position.middleRows(body_.first_particle, body_.particles) * lift_);
}

}  // namespace billow::sim
