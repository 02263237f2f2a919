// The step as the paper writes it: forces -> integrate -> filter -> contact -> move. Shared by the solver, which checks
// what comes out, and by the certificate.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "sim/step/schemes.h"
#include "sim/step/step_forces.h"

namespace billow::sim {

/// Something besides forces and filter that has a say in a step: contact, limits of strain, pins that move. Its answers
/// depend on the states that it is shown and on nothing else but what it noted since it was made or last forgot.
class StepHook {
 public:
  virtual ~StepHook() = default;
  /// A step of h [s] from `state` is about to begin. May set the velocities of pinned particles, which every scheme
  /// keeps.
  virtual void begin(State& /*state*/, double /*h*/) {}
  /// velocity (n x 3) are the filtered ones of a step that leaves `state`, whose positions are still to go `move`.
  virtual void apply(const State& /*state*/, const Move& /*move*/, Eigen::MatrixX3d& /*velocity*/) {}
  /// The step ends at `state`, which may still be changed.
  virtual void end(State& /*state*/) {}
  /// Whether everything between the last step's begin and end may be taken as a straight line.
  virtual bool straight() const { return true; }
  /// The run goes on from elsewhere: what was noted means nothing any more.
  virtual void forget() {}
  /// [J] that it put into the motion during the last step, negative where it took some out and did not lose it.
  virtual double work() const { return 0.0; }
};

/// Makes a hook for each solver: hooks have a memory of their own.
using HookMaker = std::function<std::unique_ptr<StepHook>()>;

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
  void add(std::unique_ptr<StepHook> hook) { hooks_.push_back(std::move(hook)); }

  /// state (t) -> state (t + h).
  void operator()(State& state, double h);

  /// The next step depends on its state alone, and not on what steps before it left behind.
  void forget();
  /// Whether the last step's positions went straight as far as its hooks know.
  bool straight() const;
  /// [J] of all hooks during the last step.
  double work() const;
  bool hooked() const { return !hooks_.empty(); }
  SolveCounts solve_counts() const { return integrator_->solve_counts(); }

 private:
  void finish(State& state, const Move& move);

  StepForces forces_;
  std::unique_ptr<Integrator> integrator_;
  PlacedFilter velocity_filter_;
  std::vector<std::unique_ptr<StepHook>> hooks_;
  Eigen::MatrixX3d velocity_;  // (n x 3) the new ones
  FilterScratch scratch_;
  bool prepared_ = false;  // whether the state's arrays have been seen
};

}  // namespace billow::sim
