// RK4, the classical fourth-order Runge-Kutta scheme on (x, v)' = (v, M^-1 f). Four force evaluations a step; stable to
// omega h = 2 sqrt 2. Both halves of the state are known at once, so the filter sees the final velocities.
#include "sim/step/schemes.h"

namespace billow::sim {

namespace {

class Rk4 : public Integrator {
 public:
  Move integrate(StepForces& forces, State& state, double h, Eigen::MatrixX3d& velocity) override {
    stage_ = state;
    position_sum_.setZero(state.position.rows(), 3);
    velocity_sum_.setZero(state.position.rows(), 3);
    add_slope(forces, 1.0);
    advance_stage(state, 0.5 * h);
    add_slope(forces, 2.0);
    advance_stage(state, 0.5 * h);
    add_slope(forces, 2.0);
    advance_stage(state, h);
    add_slope(forces, 1.0);
    state.position += h / 6.0 * position_sum_;
    velocity = state.velocity + h / 6.0 * velocity_sum_;
    return {};
  }

 private:
  void add_slope(StepForces& forces, double weight) {
    forces.acceleration(stage_, slope_);
    position_sum_ += weight * stage_.velocity;
    velocity_sum_ += weight * slope_;
  }

  void advance_stage(const State& state, double h) {
    stage_.position = state.position + h * stage_.velocity;
    stage_.velocity = state.velocity + h * slope_;
    stage_.time = state.time + h;
  }

  State stage_;
  Eigen::MatrixX3d slope_, position_sum_, velocity_sum_;
};

}  // namespace

std::unique_ptr<Integrator> make_rk4(const IntegratorOptions&) { return std::make_unique<Rk4>(); }

}  // namespace billow::sim
