// The forces of a step, as a scheme asks for them.
#pragma once

#include <Eigen/Core>

#include "sim/body/state.h"
#include "sim/filter/filter.h"
#include "sim/force/forces.h"

namespace billow::sim {

/// Forces with the memory that they need, and with the filter between them and the scheme where it is one of forces.
/// A constant field passes a filter unchanged, so gravity does.
class StepForces {
 public:
  /// `filter` may be null; with `frozen_position` (n x 3) it sees those positions instead of the state's. All must
  /// outlive this.
  StepForces(const Forces& forces, const Filter* filter, const Eigen::MatrixX3d* frozen_position)
      : forces_(forces), filter_(filter), frozen_position_(frozen_position) {}

  const Structure& structure() const { return forces_.structure(); }

  /// acceleration (n x 3) [m/s^2] = M^-1 f, filtered; zero for pinned particles.
  void acceleration(const State& state, Eigen::MatrixX3d& acceleration);
  /// velocity (n x 3) [m/s] = state.velocity + h M^-1 f, M^-1 f filtered.
  void kick(const State& state, double h, Eigen::MatrixX3d& velocity);
  /// force (n x 3) [N], never filtered: what the implicit schemes linearise.
  void force(const State& state, Eigen::MatrixX3d& force);
  /// As Forces::linearise.
  void linearise(const State& state, double position_weight, double velocity_weight, StiffnessMatrix& matrix) const;

 private:
  const Eigen::MatrixX3d& position_for_filter(const State& state) const {
    return frozen_position_ ? *frozen_position_ : state.position;
  }

  const Forces& forces_;
  const Filter* filter_;
  const Eigen::MatrixX3d* frozen_position_;
  ForceScratch force_scratch_;
  FilterScratch filter_scratch_;
  Eigen::MatrixX3d acceleration_;
};

}  // namespace billow::sim
