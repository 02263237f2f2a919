// Verlet as drift-kick-drift: x* = x + h/2 v, v' = v + h M^-1 f(x*, v), x' = x* + h/2 v'. Order 2 without velocity
// forces, time-reversible, one force evaluation a step, no history to keep: the state stays (x, v).
// The half-steps only shift FB Euler's cycle, so both have the same limit, with a filter too.
#include "sim/step/schemes.h"

namespace billow::sim {

namespace {

class Verlet : public Integrator {
 public:
  Move integrate(StepForces& forces, State& state, double h, Eigen::MatrixX3d& velocity) override {
    move(state, 0.5 * h);
    state.time += 0.5 * h;
    forces.kick(state, h, velocity);
    return {.by_new = 0.5 * h};
  }
};

}  // namespace

std::unique_ptr<Integrator> make_verlet(const IntegratorOptions&) { return std::make_unique<Verlet>(); }

}  // namespace billow::sim
