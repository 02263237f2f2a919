// Gravity as a law of force.
#pragma once

#include "sim/force/force_law.h"

namespace billow::sim {

/// f = m g, energy -m g . x, the same everywhere: K = C = 0.
class Gravity : public ForceLaw {
 public:
  /// `gravity` [m/s^2] (3).
  Gravity(const Structure& structure, const Eigen::Vector3d& gravity) : structure_(structure), gravity_(gravity) {}
  std::string_view name() const override { return "gravity"; }
  void add_force(const State& state, Eigen::MatrixX3d& force) const override;
  double energy(const State& state) const override;
  void add_linearisation(const State&, double, double, JacobianForm, StiffnessMatrix&) const override {}
  bool add_bound(Shapes, Linearisation&) const override { return true; }
  void add_least_damping(StiffnessMatrix&) const override {}
  bool passive() const override { return true; }
  double work(const State&, const State&) const override { return 0.0; }
  bool join(FusedSweep& sweep) const override;

 private:
  const Structure& structure_;
  Eigen::Vector3d gravity_;
};

}  // namespace billow::sim
