// Forward-backward (symplectic) Euler: v' = v + h M^-1 f(x, v), x' = x + h v'. Order 1, one force evaluation a step;
// stable to omega h = 2 and its energy stays bounded.
#include "sim/schemes.h"

namespace billow::sim {

namespace {

class ForwardBackwardEuler : public Integrator {
 public:
  void step(const Structure&, const Forces& forces, State& state, double h,
            const VelocityHook& velocity_known) override {
    forces.acceleration(state, acceleration_);
    state.velocity += h * acceleration_;
    if (velocity_known) velocity_known(state.position, state.velocity);
    state.position += h * state.velocity;
    state.time += h;
  }

 private:
  Eigen::MatrixX3d acceleration_;
};

}  // namespace

std::unique_ptr<Integrator> make_forward_backward_euler() { return std::make_unique<ForwardBackwardEuler>(); }

}  // namespace billow::sim
