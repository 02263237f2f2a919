// Muscles as a law of force: what their contraction adds to the springs that they are.
#pragma once

#include "sim/fish_motion.h"
#include "sim/forces.h"

namespace billow::sim {

/// A muscle with rest length L contracted by c pulls k (l - L (1 - c)); SpringForce gives k (l - L), and this gives the
/// k c L that is missing, along the spring. Forces are equal and opposite, so a fish alone keeps its momentum.
class MuscleForce : public ForceTerm {
 public:
  /// The muscles of the fish that is `structure.body[body]`.
  MuscleForce(const Structure& structure, int body, FishMotion motion);
  void add_force(const State& state, Eigen::MatrixX3d& force) const override;
  /// What the contraction changes in the muscles' energy: k/2 (l - L (1 - c))^2 - k/2 (l - L)^2.
  double energy(const State& state) const override;
  /// The `definite` form leaves the muscles as the springs that they are at rest length L.
  void add_linearisation(const State& state, double position_weight, double velocity_weight, JacobianForm form,
                         StiffnessMatrix& matrix) const override;

 private:
  const Structure& structure_;
  FishMotion motion_;
  std::vector<Muscle> muscle_;  // spring: within the whole structure
};

}  // namespace billow::sim
