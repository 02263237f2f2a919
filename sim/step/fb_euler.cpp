// FB Euler, forward-backward or symplectic: v' = v + h M^-1 f(x, v), x' = x + h v'. Order 1, one force evaluation a
// step; stable to omega h = 2 and its energy stays bounded.
#include "sim/step/schemes.h"

namespace billow::sim {

namespace {

class FbEuler : public Integrator {
 public:
  Move integrate(StepForces& forces, State& state, double h, Eigen::MatrixX3d& velocity) override {
    forces.kick(state, h, velocity);
    return {.by_new = h};
  }
};

}  // namespace

std::unique_ptr<Integrator> make_fb_euler(const IntegratorOptions&) { return std::make_unique<FbEuler>(); }

}  // namespace billow::sim
