// A run that is watched: its energy against the work put in, its springs against being torn. Where something goes wrong
// it goes back to the last good state and takes smaller steps.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/step/solver.h"

namespace billow::sim {

struct WatchOptions {
  bool changes_step = true;    // otherwise trouble is only written down
  double energy_scale = 0.0;   // [J] what the run can turn over; 0: its energy is not watched
  double energy_share = 0.02;  // of it by which the energy may climb
  int stretch = 64;            // steps from one good state to the next
  bool from_start = false;     // climbs count from the first energy instead of the lowest so far
  int resting_place = 32;      // stretches from one checkpoint to the next
};

/// Something that went wrong, and what was done.
struct Incident {
  enum class Kind {
    energy,       // it climbed beyond the work put in
    divergence,   // a spring was torn, or a number was none
    unexplained,  // the energy climbed, whatever the step
  };
  Kind kind = Kind::energy;
  double begin = 0.0, end = 0.0;  // [s] from the last good state to where all was well again
  double seen = 0.0;              // [s] by when it had gone wrong
  int halvings = 0;               // of the step, at most
  long discarded = 0;             // steps whose results were thrown away
};

/// Delivers states at given times, each once all up to the end of its stretch is known to be good. Which steps are
/// taken depends on the run alone, so every run of the same scene takes the same.
///
/// The energy watched is kinetic + potential - work. A velocity filter and damping only take from it; a force filter
/// exchanges some between it and the motion that it slows down, which the first energy bounds where the run starts from
/// rest (docs/method.md).
class WatchedRun {
 public:
  struct Sample {
    double time = 0.0;  // [s] as it was asked for
    State state;
  };
  /// The next time [s] at which a state is wanted, ascending from call to call; infinite when there is none.
  using NextTime = std::function<double()>;

  /// All that a run goes on from as if it had never stopped.
  struct Checkpoint {
    Solver::Checkpoint solver;
    int halvings = 0;
    double baseline = 0.0, energy_share = 0.0;  // [J], and of the scale
    int calm = 0, calm_needed = 0;
    bool incident_open = false;
    long steps = 0;
    double time = 0.0;  // [s]
    std::vector<Incident> incidents = {};
    SolveCounts solves = {};
  };
  /// Told of a place to go on from once every state before it was delivered and asked for the next.
  using Watcher = std::function<void(const Checkpoint&)>;

  /// What they refer to must outlive it.
  WatchedRun(const Structure& structure, const Forces& forces, std::unique_ptr<Solver> solver,
             const WatchOptions& options, NextTime next_time);

  /// Takes the run on from `checkpoint`, of a run of the same scene; call it before the first next(), whose time must
  /// lie after it.
  void go_on_from(const Checkpoint& checkpoint);
  /// Every run forgets at its checkpoints what its steps remember of those before, watched or not.
  void watch_checkpoints(Watcher watcher) { watcher_ = std::move(watcher); }

  /// The next state, or nothing at the end. Throws DivergenceError once all that came before is delivered.
  std::optional<Sample> next();

  const std::vector<Incident>& incidents() const { return incidents_; }
  const Solver& solver() const { return *solver_; }
  /// Steps that the states wanted so far took, those thrown away and those beyond the last left out, and the time [s]
  /// of the last of them.
  long steps() const { return steps_; }
  double time() const { return time_; }
  SolveCounts solve_counts() const;

 private:
  enum class Outcome { good, energy, divergence };
  /// What an attempt at a stretch came to.
  struct Attempt {
    Outcome outcome = Outcome::good;
    double rise = 0.0;  // [J] of the energy over the stretch
    long steps = 0;     // taken by the last of the samples,
    double time = 0.0;  // [s] and when that was
    std::vector<Sample> samples;
    std::string blocked;  // what is in the way of what, where no step is to blame
  };

  void rest();
  void run_stretch();
  Attempt attempt(const std::vector<double>& times, double end);
  Outcome judge() const;
  bool torn() const;
  void halve(const Attempt& failed, const Solver::Checkpoint& good);
  void accept(Attempt attempt, bool at_once);
  void accept_unexplained(Attempt attempt, const Solver::Checkpoint& good);
  void give_up(Attempt attempt);
  std::string cause() const;
  double energy() const;
  bool balanced() const;

  const Structure& structure_;
  const Forces& forces_;
  std::unique_ptr<Solver> solver_;
  WatchOptions options_;
  NextTime next_time_;
  double upcoming_ = 0.0;           // [s] the next time that is wanted
  double baseline_ = 0.0;           // [J] that climbs count from
  double thrown_ = 0.0;             // [J] kinetic energy at the start
  int calm_ = 0, calm_needed_ = 2;  // stretches without trouble at a halved step, and how many it takes
  long stretches_ = 0;
  long steps_ = 0;
  double time_ = 0.0;
  SolveCounts earlier_;  // of the run that this one goes on from
  Watcher watcher_;
  bool incident_open_ = false;  // the last one: steps are still halved
  std::deque<Sample> ready_;
  std::optional<std::string> divergence_;
  std::vector<Incident> incidents_;
};

}  // namespace billow::sim
