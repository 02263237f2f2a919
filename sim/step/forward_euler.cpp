// Forward Euler, the paper's equation 3: x' = x + h v, v' = v + h M^-1 f(x, v). Order 1. Without damping it gains
// energy at every step size.
#include "sim/step/schemes.h"

namespace billow::sim {

namespace {

class ForwardEuler : public Integrator {
 public:
  Move integrate(StepForces& forces, State& state, double h, Eigen::MatrixX3d& velocity) override {
    forces.kick(state, h, velocity);
    return {.by_old = h};
  }
};

}  // namespace

std::unique_ptr<Integrator> make_forward_euler(const IntegratorOptions&) { return std::make_unique<ForwardEuler>(); }

}  // namespace billow::sim
