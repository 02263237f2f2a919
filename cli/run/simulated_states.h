// States as they come from the simulation, and kept on the way where they are to be used again.
#pragma once

#include <memory>
#include <optional>

#include "cli/run/progress.h"
#include "cli/run/run.h"
#include "cli/run/schedule.h"
#include "cli/run/state_source.h"
#include "cli/run/state_store.h"

namespace billow::cli {

/// Simulates every moment that a run up to a frame is looked at in.
class SimulatedStates : public StateSource {
 public:
  SimulatedStates(const Run& run, long last_frame);
  std::optional<sim::WatchedRun::Sample> next() override { return watched_->next(); }
  RunFacts facts() const override;

 private:
  Moments moments_;
  std::unique_ptr<sim::WatchedRun> watched_;
};

/// The same, with every state written to a store. What the store holds already of the same motion, up to its last
/// checkpoint, is read instead, and the simulation goes on from there: the states are those of a run that never
/// stopped. Where one of these files is damaged the simulation begins again, and says why.
class KeptStates : public StateSource {
 public:
  /// `go_on`: use what the store holds. Throws InputError when that is of another motion.
  KeptStates(const Run& run, long last_frame, StateStore store, bool go_on, Progress& progress);
  std::optional<sim::WatchedRun::Sample> next() override;
  RunFacts facts() const override;

 private:
  std::optional<sim::WatchedRun::Checkpoint> whole_checkpoint(Progress& progress) const;
  bool holds_all_before(const sim::WatchedRun::Checkpoint& checkpoint) const;
  void start(double first_moment);
  void end(const std::string& divergence);

  const Run& run_;
  StateStore store_;
  Moments moments_;
  long frames_ = 0;  // delivered
  std::optional<sim::WatchedRun::Checkpoint> checkpoint_;
  std::optional<double> pending_;             // [s] a moment that was taken, and is the simulation's first
  std::unique_ptr<sim::WatchedRun> watched_;  // none as long as states come from the store
};

/// The frames of a finished store, and no other moments.
class StoredStates : public StateSource {
 public:
  /// From frame `first` on. Throws InputError when the store is of another motion, or has not all of the scene's
  /// frames.
  StoredStates(const Run& run, StateStore store, long first);
  std::optional<sim::WatchedRun::Sample> next() override;
  RunFacts facts() const override { return record_.facts; }

 private:
  StateStore store_;
  StateStore::Record record_;
  Schedule frames_;
};

}  // namespace billow::cli
