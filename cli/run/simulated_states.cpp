// Simulating, storing and reading back.
#include "cli/run/simulated_states.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/error.h"

namespace billow::cli {

namespace {

RunFacts facts_of(const sim::WatchedRun& run) {
  return {run.steps(), run.time(), run.solve_counts(), run.incidents(), run.solver().largest_strain()};
}

bool is_frame(const Scene& scene, double moment) {
  const double number = moment * scene.render.fps;
  return std::abs(std::round(number) / scene.render.fps - moment) <= Schedule::together;
}

}  // namespace

SimulatedStates::SimulatedStates(const Run& run, long last_frame)
    : moments_(all_schedules(run.scene, last_frame)),
      watched_(run.simulation.make_run(run.choice, [this] { return moments_.take(); })) {}

RunFacts SimulatedStates::facts() const { return facts_of(*watched_); }

KeptStates::KeptStates(const Run& run, long last_frame, StateStore store, bool go_on, Progress& progress)
    : run_(run), store_(std::move(store)), moments_(all_schedules(run.scene, last_frame)) {
  if (go_on && store_.holds_this_run()) checkpoint_ = whole_checkpoint(progress);
  store_.write_record({});
}

// One that all states before it are there with.
std::optional<sim::WatchedRun::Checkpoint> KeptStates::whole_checkpoint(Progress& progress) const {
  try {
    const auto checkpoint = store_.read_checkpoint();
    return checkpoint && holds_all_before(*checkpoint) ? checkpoint : std::nullopt;
  } catch (const InputError& error) {
    progress.say(fmt::format("warning: {}; the simulation begins again", error.what()));
    return std::nullopt;
  }
}

// A strip with other columns asks for other moments. What is there is read, as no state may turn out to be damaged when
// those before it have been handed on.
bool KeptStates::holds_all_before(const sim::WatchedRun::Checkpoint& checkpoint) const {
  Moments moments = moments_;
  for (double moment = moments.take(); moment <= checkpoint.solver.state.time; moment = moments.take()) {
    if (!store_.has(moment)) return false;
    store_.read(moment);
  }
  return true;
}

std::optional<sim::WatchedRun::Sample> KeptStates::next() {
  std::optional<sim::WatchedRun::Sample> sample;
  if (!watched_) {
    const double moment = moments_.take();
    if (checkpoint_ && moment <= checkpoint_->solver.state.time) {
      sample = store_.read(moment);
      sample->time = moment;  // as this run asks for it: duration and frames may round otherwise
    } else {
      start(moment);
    }
  }
  if (watched_) {
    try {
      sample = watched_->next();
    } catch (const DivergenceError& error) {
      end(error.what());
      throw;
    }
    if (!sample) return end(""), std::nullopt;
    store_.write(*sample);
  }
  frames_ += is_frame(run_.scene, sample->time);
  return sample;
}

void KeptStates::start(double first_moment) {
  pending_ = first_moment;
  watched_ = run_.simulation.make_run(
      run_.choice, [this] { return pending_ ? *std::exchange(pending_, std::nullopt) : moments_.take(); });
  if (checkpoint_) watched_->go_on_from(*checkpoint_);
  watched_->watch_checkpoints([this](const auto& checkpoint) { store_.write_checkpoint(checkpoint); });
}

void KeptStates::end(const std::string& divergence) { store_.write_record({facts(), frames_, true, divergence}); }

RunFacts KeptStates::facts() const {
  if (watched_) return facts_of(*watched_);
  if (!checkpoint_) return {};
  return {checkpoint_->steps, checkpoint_->time, checkpoint_->solves, checkpoint_->incidents,
          checkpoint_->solver.largest_strain};
}

StoredStates::StoredStates(const Run& run, StateStore store, long first)
    : store_(std::move(store)), frames_(frame_schedule(run.scene, frame_count(run.scene))) {
  check_stored_states(store_.folder().parent_path());
  store_.holds_this_run();
  record_ = store_.read_record();
  frames_.pass_to(first);
  check_stored_frames(store_.folder(), record_, frame_count(run.scene));
}

std::optional<sim::WatchedRun::Sample> StoredStates::next() {
  const double moment = frames_.next();
  if (!std::isfinite(moment)) return std::nullopt;
  if (frames_.taken() >= record_.frames) throw DivergenceError(record_.divergence);
  frames_.take(moment);
  sim::WatchedRun::Sample sample = store_.read(moment);
  sample.time = moment;
  return sample;
}

}  // namespace billow::cli
