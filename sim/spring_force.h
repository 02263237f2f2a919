// Springs and their damping as one law of force.
#pragma once

#include "sim/forces.h"
#include "sim/spring_plan.h"
#include "sim/spring_sink.h"

namespace billow::sim {

/// f_i = T(|d|) d/|d| + damping, d = x_j - x_i, for every spring of the structure, by each body's model.
/// The springs are laid out for the vector passes when this is made: the structure must not change after that.
class SpringForce : public ForceTerm {
 public:
  explicit SpringForce(const Structure& structure) : structure_(structure), plan_(structure) {}
  void add_force(const State& state, Eigen::MatrixX3d& force) const override;
  /// force (n x 3, [N]) = what add_force adds.
  void evaluate(const State& state, Eigen::MatrixX3d& force) const;
  /// Puts the sum of its springs, also where there are none, of every particle into `sink`, with its body's friction.
  void sweep(const State& state, const SpringSink& sink) const;
  double energy(const State& state) const override;
  void add_linearisation(const State& state, double position_weight, double velocity_weight, JacobianForm form,
                         StiffnessMatrix& matrix) const override;

 private:
  const Structure& structure_;
  SpringPlan plan_;
};

}  // namespace billow::sim
