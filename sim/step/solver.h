// Steps a state through time and stops at the first sign of divergence.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/body/state.h"
#include "sim/body/structure.h"
#include "sim/filter/filter.h"
#include "sim/force/forces.h"
#include "sim/step/integrator.h"
#include "sim/step/step.h"

namespace billow::sim {

/// Springs stretched by so many rest lengths are a sign of divergence in a run whose energy nobody watches, and worth a
/// warning in any.
constexpr double suspect_strain = 10.0;
/// No cloth is stretched so far, in balance or not.
constexpr double torn_strain = 1000.0;

/// From a time on, fewer particles are pinned: the same particles and springs under the same laws, seen otherwise by
/// scheme and filter. What it refers to must outlive the solver.
struct Release {
  double time = 0.0;  // [s] held through the first step that ends then or later
  const Structure* structure = nullptr;
  const Forces* forces = nullptr;
  std::optional<FilterOptions> filter = {};
  std::vector<HookMaker> hooks = {};
};

struct SolverOptions {
  Method method = Method::fb_euler;
  IntegratorOptions integrator = {};
  std::optional<FilterOptions> filter = {};
  std::vector<HookMaker> hooks = {};   // in the order in which they act
  std::vector<Release> releases = {};  // ascending in time
  double step = 0.0;                   // [s] > 0
  std::optional<double> limit = {};  // [s] the largest stable step as far as it is known: quoted when the run diverges
  double max_strain = suspect_strain;  // a spring longer than (1 + this) rest lengths has diverged
};

/// Owns the state of a run. Step k ends at time k h exactly, so nothing drifts over long runs. A step may be halved up
/// to ten times and be made whole again.
class Solver {
 public:
  static constexpr int most_halvings = 10;

  /// All that a run can be taken back to.
  struct Checkpoint {
    State state, previous;
    long ticks = 0, steps = 0;
    double work = 0.0, largest_strain = 0.0;
  };

  /// Structure and forces must outlive the solver. Pinned particles start at rest whatever `initial` says.
  Solver(const Structure& structure, const Forces& forces, const SolverOptions& options, State initial);

  /// One step. Throws DivergenceError naming the step, the worst particle and spring, and the step limit.
  void advance();

  /// The state at `time` [s]: steps until that time is reached, then interpolates within the last step (cubic in
  /// position, linear in velocity; linear in both where hooks act, and the step's end where they bent its way, which
  /// the state's own time then says). Times must not go back by more than one step.
  State sample(double time);

  Checkpoint checkpoint() const { return {state_, previous_, ticks_, steps_, work_, largest_strain_}; }
  void go_back(const Checkpoint& checkpoint);
  /// Steps are 1 / 2^halvings of the given one from now on. At times of coarser steps only may they become fewer.
  void set_halvings(int halvings) { halvings_ = halvings; }
  int halvings() const { return halvings_; }
  /// [s] as it is now.
  double step() const { return std::ldexp(options_.step, -halvings_); }
  /// [s] when the whole step that is the `steps`-th from here ends.
  double time_after(long steps) const { return time_of(ticks_ + steps * ticks_per_step); }

  /// That the simulation diverged, where and how; `advice` ends the sentence "the step was ... and".
  std::string divergence_text(const std::string& advice) const;
  /// What to do about a step that was given: the limit, if it is beyond that.
  std::string advice() const;
  /// [J] that laws of force which are not passive, and hooks, have put in.
  double work() const { return work_; }
  /// By how many rest lengths a spring was stretched at most, of those looked at.
  double largest_strain() const { return largest_strain_; }

  const State& state() const { return state_; }
  long steps() const { return steps_; }
  SolveCounts solve_counts() const;

 private:
  static constexpr long ticks_per_step = 1L << most_halvings;

  double time_of(long ticks) const {
    return start_time_ + static_cast<double>(ticks) * std::ldexp(options_.step, -most_halvings);
  }
  /// Between two releases.
  struct Phase {
    Phase(const Structure& structure, const Forces& forces, const SolverOptions& options,
          const std::optional<FilterOptions>& filter_options, const std::vector<HookMaker>& hooks);
    const Forces& forces;
    std::optional<Filter> filter;
    Step step;
  };
  void enter_phase();
  void check_divergence();

  const Structure& structure_;  // of the first phase: only pins differ in the others
  const Forces& forces_;        // of the first phase
  SolverOptions options_;
  std::size_t released_ = 0;      // releases before the phase
  std::unique_ptr<Phase> phase_;  // that the last step was taken in
  SolveCounts earlier_;           // of phases that are left
  State state_, previous_;
  State before_;  // the step, where work is to be accounted for
  double start_time_ = 0.0, work_ = 0.0, largest_strain_ = 0.0;
  double looked_at_square_ = 0.0;  // [m^2/s^2] the speeds' squares when every spring was last looked at
  int halvings_ = 0;
  long ticks_ = 0, steps_ = 0;
};

}  // namespace billow::sim
