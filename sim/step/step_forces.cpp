// Forces -> filter -> scheme.
#include "sim/step/step_forces.h"

namespace billow::sim {

void StepForces::acceleration(const State& state, Eigen::MatrixX3d& acceleration) {
  forces_.evaluate(state, Yield::acceleration(), acceleration, force_scratch_);
  if (filter_) filter_->apply(filter_.position(state), state.time, acceleration, filter_scratch_);
}

void StepForces::kick(const State& state, double h, Eigen::MatrixX3d& velocity) {
  if (!filter_) return forces_.evaluate(state, Yield::velocity(h), velocity, force_scratch_);
  forces_.evaluate(state, Yield::acceleration(), acceleration_, force_scratch_);
  filter_->apply_and_kick(filter_.position(state), state.time, acceleration_, state.velocity, h, velocity,
                          filter_scratch_);
}

void StepForces::force(const State& state, Eigen::MatrixX3d& force) {
  forces_.evaluate(state, Yield::force(), force, force_scratch_);
}

void StepForces::linearise(const State& state, double position_weight, double velocity_weight,
                           StiffnessMatrix& matrix) const {
  forces_.linearise(state, position_weight, velocity_weight, JacobianForm::definite, matrix);
}

}  // namespace billow::sim
