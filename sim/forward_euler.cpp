// Forward Euler, the paper's equation 3: x' = x + h v, v' = v + h M^-1 f(x, v). Order 1. Without damping it gains
// energy at every step size.
#include "sim/schemes.h"

namespace billow::sim {

namespace {

class ForwardEuler : public Integrator {
 public:
  void step(const Structure&, const Forces& forces, State& state, double h, const VelocityFilter* filter) override {
    forces.acceleration(state, acceleration_);
    velocity_ = state.velocity + h * acceleration_;
    if (filter) filter->apply(state.position, velocity_);
    state.position += h * state.velocity;
    state.velocity.swap(velocity_);
    state.time += h;
  }

 private:
  Eigen::MatrixX3d acceleration_, velocity_;
};

}  // namespace

std::unique_ptr<Integrator> make_forward_euler() { return std::make_unique<ForwardEuler>(); }

}  // namespace billow::sim
