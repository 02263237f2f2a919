// The forces of a step, as a scheme asks for them.
#pragma once

#include <Eigen/Core>

#include "sim/body/state.h"
#include "sim/filter/filter.h"
#include "sim/force/forces.h"

namespace billow::sim {

/// A filter, or none, and the positions by which it takes its distances.
struct PlacedFilter {
  const Filter* filter = nullptr;
  const Eigen::MatrixX3d* frozen_position = nullptr;  // (n x 3) instead of the state's; null: the state's

  explicit operator bool() const { return filter != nullptr; }
  const Filter* operator->() const { return filter; }
  const Eigen::MatrixX3d& position(const State& state) const {
    return frozen_position ? *frozen_position : state.position;
  }
};

/// Forces with the memory that they need, and with the filter between them and the scheme where it is one of forces.
/// A constant field passes a filter unchanged, so gravity does.
class StepForces {
 public:
  /// What they refer to must outlive this.
  StepForces(const Forces& forces, const PlacedFilter& filter) : forces_(forces), filter_(filter) {}

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
  const Forces& forces_;
  PlacedFilter filter_;
  ForceScratch force_scratch_;
  FilterScratch filter_scratch_;
  Eigen::MatrixX3d acceleration_;
};

}  // namespace billow::sim
