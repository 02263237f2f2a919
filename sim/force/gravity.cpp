// Weight.
#include "sim/force/gravity.h"

namespace billow::sim {

void Gravity::add_force(const State&, Eigen::MatrixX3d& force) const {
  for (int axis = 0; axis < 3; ++axis)
    if (gravity_(axis) != 0.0) force.col(axis) += gravity_(axis) * structure_.mass;
}

double Gravity::energy(const State& state) const { return -structure_.mass.dot(state.position * gravity_); }

bool Gravity::join(FusedSweep& sweep) const {
  sweep.gravity += gravity_;
  return true;
}

}  // namespace billow::sim
