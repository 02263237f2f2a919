// The classical fourth-order Runge-Kutta scheme on (x, v)' = (v, M^-1 f). Four force evaluations a step; stable to
// omega h = 2 sqrt 2. Both halves of the state are known at once, so the filter sees the final velocities.
#include "sim/schemes.h"

namespace billow::sim {

namespace {

class RungeKutta4 : public Integrator {
 public:
  void step(const Structure&, const Forces& forces, State& state, double h, const VelocityFilter* filter) override {
    stage_ = state;
    position_sum_ = Eigen::MatrixX3d::Zero(state.position.rows(), 3);
    velocity_sum_ = position_sum_;
    add_slope(forces, 1.0);
    advance_stage(state, 0.5 * h);
    add_slope(forces, 2.0);
    advance_stage(state, 0.5 * h);
    add_slope(forces, 2.0);
    advance_stage(state, h);
    add_slope(forces, 1.0);
    state.position += h / 6.0 * position_sum_;
    state.velocity += h / 6.0 * velocity_sum_;
    state.time += h;
    if (filter) filter->apply(state.position, state.velocity);
  }

 private:
  void add_slope(const Forces& forces, double weight) {
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

std::unique_ptr<Integrator> make_runge_kutta_4() { return std::make_unique<RungeKutta4>(); }

}  // namespace billow::sim
