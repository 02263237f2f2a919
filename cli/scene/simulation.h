// A scene made ready to step: structure, forces, and the step that was chosen.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/scene/scene.h"
#include "sim/body/state.h"
#include "sim/body/structure.h"
#include "sim/contact/contact.h"
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
  int phase = 0;                                    // Simulation's, that all this was found of
  sim::EigenvalueEstimate k0;                       // [1/s^2]
  std::optional<sim::EigenvalueEstimate> filtered;  // Algorithm 1's alpha [1/s^2] where the scene filters

  /// `found` into one of the limits.
  void take(const sim::CertifiedStep& found, std::optional<double>& limit);
  bool any_shape_binds() const { return any_shape && !only_at_rest && (!certified || *any_shape < *certified); }
};

/// Everything that a run needs besides time. Immovable: the forces refer to the structure. What is asked without a
/// phase is that of the start, before any pin lets go; the laws and their energies are the same in all.
class Simulation {
 public:
  /// Builds structure and forces of `scene`, which must outlive this. Throws InputError.
  explicit Simulation(const Scene& scene);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Between two times at which pins let go.
  struct Phase {
    Phase(const Scene& scene, double begin, sim::Structure structure);
    const sim::Filter* filter_operator() const { return built_filter ? &*built_filter : nullptr; }

    double begin;  // [s]
    sim::Structure structure;
    sim::Forces forces;
    std::optional<sim::Filter> built_filter;   // make_filter's; none where the scene does not filter, or need not
    std::optional<sim::FilterOptions> filter;  // what makes it again
    std::optional<sim::ContactModel> contact;  // none where nothing touches
  };

  const Phase& phase(int number = 0) const { return *phases_[static_cast<std::size_t>(number)]; }
  int phases() const { return static_cast<int>(phases_.size()); }
  /// Whose time `time` [s] is; within the step in which it begins the run is still in the one before.
  const Phase& phase_at(double time) const;
  const sim::Structure& structure() const { return phase().structure; }
  const sim::Forces& forces() const { return phase().forces; }
  const sim::State& initial_state() const { return initial_; }
  /// The scene's filter as make_filter chose it; none where the scene does not filter, or need not.
  const std::optional<sim::FilterOptions>& filter() const { return phase().filter; }
  /// The same as an operator; null for none.
  const sim::Filter* filter_operator() const { return phase().filter_operator(); }

  /// A solver at the scene's start, taking steps of `choice`.
  std::unique_ptr<sim::Solver> make_solver(const StepChoice& choice) const;
  /// The same, watched: states at what `next_time` comes to.
  std::unique_ptr<sim::WatchedRun> make_run(const StepChoice& choice, sim::WatchedRun::NextTime next_time) const;
  /// The limits alone, no step chosen: also where there is none to choose. Of the phase that leaves the least room.
  StepChoice find_limits() const;
  /// The step that the scene asks for. Schemes without a limit take the paper's 0.01 s. Throws InputError when every
  /// step grows.
  StepChoice choose_step() const;

 private:
  sim::CertifiedStep certified_limit(const Phase& phase, const sim::Linearisation& linearisation,
                                     const sim::StiffnessMatrix* least_damping) const;
  void check_contact_at_start() const;
  StepChoice find_limits(const Phase& phase) const;
  std::vector<sim::HookMaker> hooks(const Phase& phase) const;
  sim::SolverOptions solver_options(const StepChoice& choice) const;
  std::string refusal(const Phase& phase) const;

  const Scene& scene_;
  std::vector<std::unique_ptr<Phase>> phases_;  // at least one
  sim::State initial_;
};

}  // namespace billow::cli
