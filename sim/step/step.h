// The step as the paper writes it: forces -> integrate -> filter -> contact -> move. Shared by the solver, which checks
// what comes out, and by the certificate.
#pragma once

#include <memory>
#include <vector>

#include "sim/step/schemes.h"
#include "sim/step/step_forces.h"

namespace billow::sim {

/// Something that acts on the new velocities between the filter and the move: contact, limits of strain.
class VelocityHook {
 public:
  virtual ~VelocityHook() = default;
  /// velocity (n x 3) are the filtered ones of a step that leaves `state`, whose positions are still to go `move`.
  virtual void apply(const State& state, const Move& move, Eigen::MatrixX3d& velocity) = 0;
};

/// One scheme with, or without, one filter. The filter is a post-process: of the velocities as soon as the scheme knows
/// them, or of the accelerations M^-1 f as soon as the forces are summed (explicit schemes only).
class Step {
 public:
  /// `filter` may be null. Forces and filter must outlive this object. With `frozen_position` (n x 3) the filter sees
  /// those positions instead of the state's: what a linearised step needs, whose states are displacements.
  /// Throws InputError for a force filter with an implicit scheme, which has no such place.
  Step(const Forces& forces, Method method, const IntegratorOptions& options, const Filter* filter,
       const Eigen::MatrixX3d* frozen_position = nullptr);
  Step(const Step&) = delete;
  Step& operator=(const Step&) = delete;

  /// Hooks act in the order in which they were added.
  void add(std::unique_ptr<VelocityHook> hook) { hooks_.push_back(std::move(hook)); }

  /// state (t) -> state (t + h).
  void operator()(State& state, double h);

  SolveCounts solve_counts() const { return integrator_->solve_counts(); }

 private:
  void finish(State& state, const Move& move);

  StepForces forces_;
  std::unique_ptr<Integrator> integrator_;
  PlacedFilter velocity_filter_;
  std::vector<std::unique_ptr<VelocityHook>> hooks_;
  Eigen::MatrixX3d velocity_;  // (n x 3) the new ones
  FilterScratch scratch_;
  bool prepared_ = false;  // whether the state's arrays have been seen
};

}  // namespace billow::sim
