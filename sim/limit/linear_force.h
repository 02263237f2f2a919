// The forces of a linearised structure as a law.
#pragma once

#include "sim/force/force_law.h"
#include "sim/force/forces.h"

namespace billow::sim {

/// f = -K x - C v, where the state's positions are displacements. One for each that evaluates it at the same time.
class LinearForce : public ForceLaw {
 public:
  /// `linearisation` must outlive this.
  explicit LinearForce(const Linearisation& linearisation)
      : linearisation_(linearisation), damped_(!linearisation.damping.is_zero()) {}
  std::string_view name() const override { return "the linearised forces"; }
  void add_force(const State& state, Eigen::MatrixX3d& force) const override;
  double energy(const State& state) const override;
  void add_linearisation(const State& state, double position_weight, double velocity_weight, JacobianForm form,
                         StiffnessMatrix& matrix) const override;
  bool add_bound(Shapes shapes, Linearisation& bound) const override;
  void add_least_damping(StiffnessMatrix& damping) const override { damping.add_scaled(linearisation_.damping, 1.0); }
  bool passive() const override { return true; }
  double work(const State&, const State&) const override { return 0.0; }
  bool join(FusedSweep&) const override { return false; }

 private:
  const Linearisation& linearisation_;
  bool damped_;
  mutable Eigen::MatrixX3d product_;
};

/// Only these forces. `structure` and `linearisation` must outlive them.
Forces linear_forces(const Structure& structure, const Linearisation& linearisation);

}  // namespace billow::sim
