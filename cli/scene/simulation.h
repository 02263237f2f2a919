// A scene made ready to step: structure, forces, and the step that was chosen.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/scene/scene.h"
#include "sim/body/state.h"
#include "sim/body/structure.h"
#include "sim/force/forces.h"
#include "sim/limit/certificate.h"
#include "sim/limit/step_setter.h"
#include "sim/linear/max_eigenvalue.h"
#include "sim/step/solver.h"
#include "sim/step/watched_run.h"

namespace billow::cli {

/// The step of a run, where it comes from, and the limits it was weighed against. A missing limit means that the
/// scheme has none.
struct StepChoice {
  double step = 0.0;            // [s]
  std::string bound;            // "given", "certified at rest", "certified for any shape", "paper", "unlimited: ..."
  std::optional<double> limit;  // [s] the smaller of the two certified ones
  std::optional<double> paper;  // [s] equation 11, with Algorithm 1's alpha where the scene filters
  std::optional<double> certified;                  // [s] of the linearised step at rest
  std::optional<double> any_shape;                  // [s] of the stiffest that any shape can be
  std::vector<std::string> unbounded;               // laws that no limit counts
  std::optional<sim::StepSetter> setter;            // the place that makes the step much smaller than it is elsewhere
  bool only_at_rest = false;                        // forward Euler's, where nothing damps every motion at any shape
  bool always_grows = false;                        // slowly, at every step alike: the filter's doing
  sim::EigenvalueEstimate k0;                       // [1/s^2]
  std::optional<sim::EigenvalueEstimate> filtered;  // Algorithm 1's alpha [1/s^2] where the scene filters

  /// `found` into one of the limits.
  void take(const sim::CertifiedStep& found, std::optional<double>& limit);
  bool any_shape_binds() const { return any_shape && !only_at_rest && (!certified || *any_shape < *certified); }
};

/// Everything that a run needs besides time. Immovable: the forces refer to the structure.
class Simulation {
 public:
  /// Builds structure and forces of `scene`, which must outlive this. Throws InputError.
  explicit Simulation(const Scene& scene);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  const sim::Structure& structure() const { return structure_; }
  const sim::Forces& forces() const { return *forces_; }
  const sim::State& initial_state() const { return initial_; }
  /// The scene's filter as make_filter chose it; none where the scene does not filter, or need not.
  const std::optional<sim::FilterOptions>& filter() const { return filter_; }
  /// The same as an operator; null for none.
  const sim::Filter* filter_operator() const { return operator_ ? &*operator_ : nullptr; }

  /// A solver at the scene's start, taking steps of `choice`.
  std::unique_ptr<sim::Solver> make_solver(const StepChoice& choice) const;
  /// The same, watched: states at what `next_time` comes to.
  std::unique_ptr<sim::WatchedRun> make_run(const StepChoice& choice, sim::WatchedRun::NextTime next_time) const;
  /// The limits alone, no step chosen: also where there is none to choose.
  StepChoice find_limits() const;
  /// The step that the scene asks for. Schemes without a limit take the paper's 0.01 s. Throws InputError when every
  /// step grows.
  StepChoice choose_step() const;

 private:
  sim::CertifiedStep certified_limit(const sim::Linearisation& linearisation,
                                     const sim::StiffnessMatrix* least_damping) const;
  sim::SolverOptions solver_options(const StepChoice& choice) const;
  std::string refusal() const;

  const Scene& scene_;
  sim::Structure structure_;
  std::unique_ptr<sim::Forces> forces_;
  sim::State initial_;
  std::optional<sim::FilterOptions> filter_;
  std::optional<sim::Filter> operator_;  // the same, as an operator
};

}  // namespace billow::cli
