// Every scheme keeps a pinned particle's velocity, and by old and new velocities alike positions go h times that: a
// particle at x whose velocity is (target(t + h) - x) / h lands on its target. That velocity is the motion's own half a
// step later, to second order: implicit schemes see the pin where it will be, Verlet's one evaluation where it is half
// a step later to O(h^2).
//
// Work. With the force f that springs, gravity and damping exert on a pinned particle, whatever moves it exerts
// m a - f, whose work over a step is the change of m v^2 / 2 less the integral of f . dx, here by the trapezoidal rule.
// Kinetic and potential energy count pinned particles as well, so that their sum less this work stays constant but for
// what damps and what the scheme errs by.
#include "sim/step/moving_pins.h"

#include "base/error.h"

namespace billow::sim {

MovingPins::MovingPins(const Structure& structure, const Forces& forces, const std::vector<MovingPin>& pins)
    : structure_(structure), forces_(forces), pins_(pins) {
  for (std::size_t p = 0; p < pins_.size(); ++p)
    for (const int particle : pins_[p].particle) {
      if (particle < 0 || particle >= structure.particles() || !structure.pinned(particle))
        throw InputError("particle " + std::to_string(particle) + " is not pinned, so no pin can move it");
      carried_.push_back({particle, p});
    }
  const auto count = static_cast<Eigen::Index>(carried_.size());
  for (Eigen::MatrixX3d* rows : {&start_, &target_, &force_, &end_force_}) rows->setZero(count, 3);
}

void MovingPins::begin(State& state, double h) {
  std::vector<Eigen::Isometry3d> place;
  for (const MovingPin& pin : pins_) place.push_back(pin.motion.at(state.time + h));
  for (Eigen::Index c = 0; c < target_.rows(); ++c) {
    const auto [particle, pin] = carried_[static_cast<std::size_t>(c)];
    start_.row(c) = state.position.row(particle);
    target_.row(c) = (place[pin] * structure_.rest_position.row(particle).transpose()).transpose();
  }
  before_ = kinetic_energy(state);
  const bool moves = target_ != start_;
  if (moves && !force_known_) find_force(state, force_);
  force_known_ = moves;
  for (Eigen::Index c = 0; c < target_.rows(); ++c)
    state.velocity.row(carried_[static_cast<std::size_t>(c)].particle) = (target_.row(c) - start_.row(c)) / h;
}

// The velocity is the motion's own from here to the next step: pictures, and the first law of motion for what lets go.
void MovingPins::end(State& state) {
  std::vector<Eigen::Affine3d> velocity;
  for (const MovingPin& pin : pins_) velocity.push_back(pin.motion.velocity_at(state.time));
  for (Eigen::Index c = 0; c < target_.rows(); ++c) {
    const auto [particle, pin] = carried_[static_cast<std::size_t>(c)];
    state.position.row(particle) = target_.row(c);
    state.velocity.row(particle) = (velocity[pin] * structure_.rest_position.row(particle).transpose()).transpose();
  }
  work_ = kinetic_energy(state) - before_;
  if (!force_known_) return;
  find_force(state, end_force_);
  work_ -= 0.5 * (force_ + end_force_).cwiseProduct(target_ - start_).sum();
  force_.swap(end_force_);
}

void MovingPins::find_force(const State& state, Eigen::MatrixX3d& force) {
  forces_.evaluate(state, Yield::force(), all_forces_, scratch_);
  for (Eigen::Index c = 0; c < force.rows(); ++c)
    force.row(c) = all_forces_.row(carried_[static_cast<std::size_t>(c)].particle);
}

double MovingPins::kinetic_energy(const State& state) const {
  double sum = 0.0;
  for (const Carried& carried : carried_)
    sum += 0.5 * structure_.mass(carried.particle) * state.velocity.row(carried.particle).squaredNorm();
  return sum;
}

}  // namespace billow::sim
