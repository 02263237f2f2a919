// Stretches of steps, each accepted or gone back from.
#include "sim/step/watched_run.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "sim/body/momenta.h"

namespace billow::sim {

namespace {

// Half the step that leaves more than this of a rise in energy has not caused it: first-order schemes halve it.
constexpr double unhelped_share = 0.7;

// Energy that climbs without cause may climb so much farther before it is looked at again.
constexpr double wider = 1.5;

constexpr int most_calm_needed = 256;

}  // namespace

WatchedRun::WatchedRun(const Structure& structure, const Forces& forces, std::unique_ptr<Solver> solver,
                       const WatchOptions& options, NextTime next_time)
    : structure_(structure),
      forces_(forces),
      solver_(std::move(solver)),
      options_(options),
      next_time_(std::move(next_time)),
      upcoming_(next_time_()),
      baseline_(energy()),
      thrown_(kinetic_energy(structure, solver_->state())) {}

void WatchedRun::go_on_from(const Checkpoint& checkpoint) {
  solver_->set_halvings(checkpoint.halvings);
  solver_->go_back(checkpoint.solver);
  baseline_ = checkpoint.baseline, options_.energy_share = checkpoint.energy_share;
  calm_ = checkpoint.calm, calm_needed_ = checkpoint.calm_needed;
  incident_open_ = checkpoint.incident_open, incidents_ = checkpoint.incidents;
  steps_ = checkpoint.steps, time_ = checkpoint.time;
  earlier_ = checkpoint.solves;
}

SolveCounts WatchedRun::solve_counts() const {
  SolveCounts counts = earlier_;
  return counts += solver_->solve_counts();
}

// Forgetting is a part of every run, so that one that goes on from here takes the same steps.
void WatchedRun::rest() {
  solver_->go_back(solver_->checkpoint());
  if (!watcher_) return;
  watcher_({solver_->checkpoint(), solver_->halvings(), baseline_, options_.energy_share, calm_, calm_needed_,
            incident_open_, steps_, time_, incidents_, solve_counts()});
}

double WatchedRun::energy() const {
  const State& state = solver_->state();
  return kinetic_energy(structure_, state) + forces_.potential_energy(state) - solver_->work();
}

bool WatchedRun::balanced() const {
  return options_.energy_scale == 0.0 || energy() - baseline_ <= options_.energy_share * options_.energy_scale;
}

std::optional<WatchedRun::Sample> WatchedRun::next() {
  while (ready_.empty() && !divergence_ && std::isfinite(upcoming_)) run_stretch();
  if (ready_.empty()) {
    if (divergence_) throw DivergenceError(*divergence_);
    return std::nullopt;
  }
  Sample sample = std::move(ready_.front());
  ready_.pop_front();
  return sample;
}

void WatchedRun::run_stretch() {
  if (stretches_ > 0 && stretches_ % options_.resting_place == 0) rest();
  ++stretches_;
  const Solver::Checkpoint good = solver_->checkpoint();
  const double end = solver_->time_after(options_.stretch);
  std::vector<double> times;
  for (; upcoming_ <= end; upcoming_ = next_time_()) times.push_back(upcoming_);
  double rise_before = INFINITY;
  for (bool at_once = true;; at_once = false) {
    Attempt now = attempt(times, end);
    if (now.outcome == Outcome::good) return accept(std::move(now), at_once);
    const bool can_halve = options_.changes_step && solver_->halvings() < Solver::most_halvings;
    if (now.outcome == Outcome::energy && (!can_halve || now.rise > unhelped_share * rise_before))
      return accept_unexplained(std::move(now), good);
    if (now.outcome == Outcome::divergence && (!can_halve || (!at_once && torn()))) return give_up(std::move(now));
    rise_before = now.rise;
    halve(now, good);
  }
}

// To `end` also where no more states are wanted: what is judged must not depend on what is.
WatchedRun::Attempt WatchedRun::attempt(const std::vector<double>& times, double end) {
  Attempt result;
  const double begin = energy();
  try {
    for (const double time : times) result.samples.push_back({time, solver_->sample(time)});
    result.steps = solver_->steps(), result.time = solver_->state().time;
    while (solver_->state().time < end - 0.5 * solver_->step()) solver_->advance();
    result.outcome = judge();
  } catch (const BlockedError& error) {
    result.outcome = Outcome::divergence;
    result.blocked = error.what();
  } catch (const DivergenceError&) {
    result.outcome = Outcome::divergence;
  }
  result.rise = energy() - begin;
  return result;
}

WatchedRun::Outcome WatchedRun::judge() const { return balanced() ? Outcome::good : Outcome::energy; }

// Whether the state that diverged has not gained energy: its springs are that long because something pulls at them.
bool WatchedRun::torn() const { return std::isfinite(energy()) && balanced(); }

void WatchedRun::halve(const Attempt& failed, const Solver::Checkpoint& good) {
  const State& state = solver_->state();
  if (!incident_open_) {
    const auto kind = failed.outcome == Outcome::energy ? Incident::Kind::energy : Incident::Kind::divergence;
    incidents_.push_back({.kind = kind, .begin = good.state.time, .seen = state.time});
    incident_open_ = true;
  }
  Incident& incident = incidents_.back();
  incident.discarded += solver_->steps() - good.steps;
  solver_->go_back(good);
  solver_->set_halvings(solver_->halvings() + 1);
  incident.halvings = std::max(incident.halvings, solver_->halvings());
  calm_ = 0;
  calm_needed_ = std::min(2 * calm_needed_, most_calm_needed);
}

void WatchedRun::accept(Attempt attempt, bool at_once) {
  steps_ = attempt.steps, time_ = attempt.time;
  for (Sample& sample : attempt.samples) ready_.push_back(std::move(sample));
  if (!options_.from_start) baseline_ = std::min(baseline_, energy());
  if (incident_open_) incidents_.back().end = solver_->state().time;
  if (solver_->halvings() == 0 || !at_once || ++calm_ < calm_needed_) return;
  calm_ = 0;
  solver_->set_halvings(solver_->halvings() - 1);
  incident_open_ = solver_->halvings() > 0;
}

void WatchedRun::accept_unexplained(Attempt attempt, const Solver::Checkpoint& good) {
  const double time = solver_->state().time;
  const auto kind = options_.changes_step ? Incident::Kind::unexplained : Incident::Kind::energy;
  if (incident_open_ && options_.changes_step)
    incidents_.back().kind = kind;
  else
    incidents_.push_back({.kind = kind, .begin = good.state.time, .end = time, .seen = time});
  baseline_ = energy();
  options_.energy_share *= wider;
  accept(std::move(attempt), false);
}

void WatchedRun::give_up(Attempt attempt) {
  divergence_ = attempt.blocked.empty() ? solver_->divergence_text(cause()) : attempt.blocked;
  steps_ = solver_->steps(), time_ = solver_->state().time;
  for (Sample& sample : attempt.samples) ready_.push_back(std::move(sample));
}

// The end of "the step was ... and".
std::string WatchedRun::cause() const {
  if (torn())
    return thrown_ > 0.5 * options_.energy_scale
               ? "no step is to blame: the springs are too soft for the speed that the body starts with; raise the "
                 "stiffness, or start it slower"
               : "no step is to blame: the springs are too soft for what pulls at them; raise the stiffness or lower "
                 "the mass";
  if (options_.changes_step)
    return "even this thousandth of the step that was chosen does not hold what drives the motion; look at the "
           "muscles, "
           "the water and the filter, or give the bodies more damping";
  return solver_->advice();
}

}  // namespace billow::sim
