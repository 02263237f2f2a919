// Springs and their damping as one law of force.
#pragma once

#include "sim/forces.h"

namespace billow::sim {

/// f_i = T(|d|) d/|d| + damping, d = x_j - x_i, for every spring of the structure, by each body's model.
class SpringForce : public ForceTerm {
 public:
  explicit SpringForce(const Structure& structure) : structure_(structure) {}
  void add_force(const State& state, Eigen::MatrixX3d& force) const override;
  double energy(const State& state) const override;
  void add_linearisation(const State& state, double position_weight, double velocity_weight, JacobianForm form,
                         StiffnessMatrix& matrix) const override;

 private:
  const Structure& structure_;
};

}  // namespace billow::sim
