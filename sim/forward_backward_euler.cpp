// Forward-backward (symplectic) Euler: v' = v + h M^-1 f(x, v), x' = x + h v'. Order 1, one force evaluation a step;
// stable to omega h = 2 and its energy stays bounded.
#include "sim/schemes.h"

namespace billow::sim {

namespace {

class ForwardBackwardEuler : public Integrator {
 public:
  void step(const Structure&, const Forces& forces, State& state, double h, const VelocityFilter* filter) override {
    forces.kick(state, h, velocity_);
    if (filter) {
      filter->apply_and_move(velocity_, state, h);
    } else {
      state.velocity.swap(velocity_);
      move(state, h);
    }
    state.time += h;
  }

 private:
  Eigen::MatrixX3d velocity_;
};

}  // namespace

std::unique_ptr<Integrator> make_forward_backward_euler() { return std::make_unique<ForwardBackwardEuler>(); }

}  // namespace billow::sim
