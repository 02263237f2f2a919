// The step as the paper writes it: forces -> integrate -> filter. Shared by the solver and the certificate.
#pragma once

#include <memory>

#include "sim/filter.h"
#include "sim/forces.h"
#include "sim/integrator.h"

namespace billow::sim {

/// One scheme with, or without, one filter. The filter is a post-process: of the velocities as soon as the scheme knows
/// them, or of the accelerations M^-1 f as soon as the forces are summed (explicit schemes only).
class FilteredStep {
 public:
  /// `filter` may be null. Forces, structure and filter must outlive this object. With `frozen_position` (n x 3) the
  /// filter sees those positions instead of the state's: what a linearised step needs, whose states are displacements.
  /// Throws InputError for a force filter with an implicit scheme, which has no such place.
  FilteredStep(const Structure& structure, const Forces& forces, Method method, const IntegratorOptions& options,
               const Filter* filter, const Eigen::MatrixX3d* frozen_position = nullptr);
  ~FilteredStep();
  FilteredStep(const FilteredStep&) = delete;
  FilteredStep& operator=(const FilteredStep&) = delete;

  void operator()(State& state, double h);
  SolveCounts solve_counts() const { return integrator_->solve_counts(); }

 private:
  const Structure& structure_;
  const Forces& forces_;
  std::unique_ptr<Forces> filtered_forces_;
  std::unique_ptr<Integrator> integrator_;
  std::unique_ptr<VelocityFilter> velocity_filter_;
  bool prepared_ = false;  // whether the state's arrays have been seen
  double time_ = 0.0;      // [s] of the step being taken, for filters whose lambda varies
};

}  // namespace billow::sim
