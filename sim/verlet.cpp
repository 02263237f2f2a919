// Verlet as drift-kick-drift: x* = x + h/2 v, v' = v + h M^-1 f(x*, v), x' = x* + h/2 v'. Order 2 without velocity
// forces, time-reversible, one force evaluation a step, no history to keep: the state stays (x, v).
// The half-steps only shift FB Euler's cycle, so both have the same limit, with a filter too.
#include "sim/schemes.h"

namespace billow::sim {

namespace {

class Verlet : public Integrator {
 public:
  void step(const Structure&, const Forces& forces, State& state, double h, const VelocityFilter* filter) override {
    state.position += 0.5 * h * state.velocity;
    state.time += 0.5 * h;
    forces.acceleration(state, acceleration_);
    state.velocity += h * acceleration_;
    if (filter) filter->apply(state.position, state.velocity);
    state.position += 0.5 * h * state.velocity;
    state.time += 0.5 * h;
  }

 private:
  Eigen::MatrixX3d acceleration_;
};

}  // namespace

std::unique_ptr<Integrator> make_verlet() { return std::make_unique<Verlet>(); }

}  // namespace billow::sim
