// Friction with the fluid around a body as a law of force.
#pragma once

#include "sim/force/force_law.h"

namespace billow::sim {

/// f = -c v per particle, c by body: C = c I, at every state.
class FluidFriction : public ForceLaw {
 public:
  explicit FluidFriction(const Structure& structure) : structure_(structure) {}
  std::string_view name() const override { return "friction"; }
  void add_force(const State& state, Eigen::MatrixX3d& force) const override;
  double energy(const State&) const override { return 0.0; }
  void add_linearisation(const State& state, double position_weight, double velocity_weight, JacobianForm form,
                         StiffnessMatrix& matrix) const override;
  bool add_bound(Shapes shapes, Linearisation& bound) const override;
  void add_least_damping(StiffnessMatrix& damping) const override;
  bool passive() const override { return true; }
  double work(const State&, const State&) const override { return 0.0; }
  bool join(FusedSweep& sweep) const override;

 private:
  const Structure& structure_;
};

/// matrix += weight C of every body's friction.
void add_friction(const Structure& structure, double weight, StiffnessMatrix& matrix);

}  // namespace billow::sim
