// What water carries of a body's weight as a law of force.
#pragma once

#include "sim/force/force_law.h"

namespace billow::sim {

/// f = -share m gravity on every particle of a body: 1 makes it float where it is. K = C = 0.
class Buoyancy : public ForceLaw {
 public:
  /// Of `structure.body[body]`; `gravity` [m/s^2].
  Buoyancy(const Structure& structure, int body, const Eigen::Vector3d& gravity, double share)
      : structure_(structure), body_(structure.body[static_cast<std::size_t>(body)]), lift_(-share * gravity) {}
  std::string_view name() const override { return "buoyancy"; }
  void add_force(const State& state, Eigen::MatrixX3d& force) const override;
  /// -share times the energy of the weight.
  double energy(const State& state) const override;
  void add_linearisation(const State&, double, double, JacobianForm, StiffnessMatrix&) const override {}
  bool add_bound(Shapes, Linearisation&) const override { return true; }
  void add_least_damping(StiffnessMatrix&) const override {}
  bool passive() const override { return true; }
  double work(const State&, const State&) const override { return 0.0; }
  bool join(FusedSweep&) const override { return false; }

 private:
  const Structure& structure_;
  const Body& body_;
  Eigen::Vector3d lift_;  // [m/s^2]
};

}  // namespace billow::sim
