// -c v.
#include "sim/force/fluid_friction.h"

namespace billow::sim {

void FluidFriction::add_force(const State& state, Eigen::MatrixX3d& force) const {
  for (const Body& body : structure_.body) {
    if (body.friction == 0.0) continue;
    force.middleRows(body.first_particle, body.particles) -=
        body.friction * state.velocity.middleRows(body.first_particle, body.particles);
  }
}

void FluidFriction::add_linearisation(const State&, double, double velocity_weight, JacobianForm,
                                      StiffnessMatrix& matrix) const {
  add_friction(structure_, velocity_weight, matrix);
}

bool FluidFriction::add_bound(Shapes, Linearisation& bound) const {
  add_friction(structure_, 1.0, bound.damping);
  return true;
}

void FluidFriction::add_least_damping(StiffnessMatrix& damping) const { add_friction(structure_, 1.0, damping); }

// The sweep knows one friction for each body.
bool FluidFriction::join(FusedSweep& sweep) const {
  if (sweep.friction) return false;
  sweep.friction = true;
  return true;
}

void add_friction(const Structure& structure, double weight, StiffnessMatrix& matrix) {
  for (const Body& body : structure.body)
    for (int i = body.first_particle; i < body.first_particle + body.particles; ++i)
      matrix.add_diagonal(i, weight * body.friction);
}

}  // namespace billow::sim
