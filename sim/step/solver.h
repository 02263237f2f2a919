// Steps a state through time and stops at the first sign of divergence.
#pragma once

#include <optional>
#include <string>

#include "sim/body/state.h"
#include "sim/body/structure.h"
#include "sim/filter/filter.h"
#include "sim/force/forces.h"
#include "sim/step/integrator.h"
#include "sim/step/step.h"

namespace billow::sim {

struct SolverOptions {
  Method method = Method::fb_euler;
  IntegratorOptions integrator = {};
  std::optional<FilterOptions> filter = {};
  double step = 0.0;                 // [s] > 0
  std::optional<double> limit = {};  // [s] the largest stable step as far as it is known: quoted when the run diverges
  double max_strain = 10.0;          // a spring longer than (1 + this) rest lengths has diverged
};

/// Owns the state of a run. Step k ends at time k h exactly, so nothing drifts over long runs.
class Solver {
 public:
  /// Structure and forces must outlive the solver. Pinned particles start at rest whatever `initial` says.
  Solver(const Structure& structure, const Forces& forces, const SolverOptions& options, State initial);

  /// One step. Throws DivergenceError naming the step, the worst particle and spring, and the step limit.
  void advance();

  /// The state at `time` [s]: steps until that time is reached, then interpolates within the last step (cubic in
  /// position, linear in velocity). Times must not go back by more than one step.
  State sample(double time);

  const State& state() const { return state_; }
  long steps() const { return steps_; }
  SolveCounts solve_counts() const { return step_.solve_counts(); }

 private:
  void check_divergence() const;
  [[noreturn]] void report_divergence() const;
  std::string advice() const;

  const Structure& structure_;
  SolverOptions options_;
  std::optional<Filter> filter_;
  Step step_;
  State state_, previous_;
  double start_time_ = 0.0;
  long steps_ = 0;
};

}  // namespace billow::sim
