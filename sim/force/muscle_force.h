// Muscles as a law of force: what their contraction adds to the springs that they are.
#pragma once

#include <vector>

#include "sim/body/fish_motion.h"
#include "sim/force/force_law.h"

namespace billow::sim {

/// A muscle with rest length L contracted by c pulls k (l - L (1 - c)); SpringForce gives k (l - L), and this gives the
/// k c L that is missing, along the spring. Forces are equal and opposite, so a fish alone keeps its momentum.
class MuscleForce : public ForceLaw {
 public:
  /// The muscles of the fish that is `structure.body[body]`.
  MuscleForce(const Structure& structure, int body, FishMotion motion);
  std::string_view name() const override { return "the muscles"; }
  void add_force(const State& state, Eigen::MatrixX3d& force) const override;
  /// What the contraction changes in the muscles' energy: k/2 (l - L (1 - c))^2 - k/2 (l - L)^2.
  double energy(const State& state) const override;
  /// The `definite` form leaves the muscles as the springs that they are at rest length L.
  void add_linearisation(const State& state, double position_weight, double velocity_weight, JacobianForm form,
                         StiffnessMatrix& matrix) const override;
  /// At rest: the sideways stiffness k c of the largest contraction of the motion. At any shape nothing that the
  /// springs' own bound has not: together they pull k (l - L (1 - c)) < k l.
  bool add_bound(Shapes shapes, Linearisation& bound) const override;
  void add_least_damping(StiffnessMatrix&) const override {}
  /// Only where they never contract.
  bool passive() const override;
  /// What the change of their rest lengths alone does to their energy: the mean of that at either state.
  double work(const State& before, const State& after) const override;
  bool join(FusedSweep&) const override { return false; }

 private:
  double energy(const Eigen::MatrixX3d& position, double time) const;
  /// k c L [N] of a muscle at `time` [s].
  double tension(const Muscle& muscle, double time) const;

  const Structure& structure_;
  FishMotion motion_;
  std::vector<Muscle> muscle_;  // spring: within the whole structure
};

}  // namespace billow::sim
