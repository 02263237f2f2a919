// The states of a run, kept: one file each, and what a longer run goes on from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/run/state_source.h"
#include "cli/scene/scene.h"
#include "cli/scene/simulation.h"

namespace billow::cli {

/// The folder DIR/states:
///   frame_0001.npz               the state of each frame: position [m] and velocity [m/s], both (n x 3), float64, and
///   time_00000.010000000.npz     that of each other moment; its time [s], and the moment [s] that it was wanted for
///   checkpoint.npz               where the simulation goes on
///   states.json                  whose states these are, and how they came about
/// Particles lie as `billow structure` numbers them, body after body.
class StateStore {
 public:
  static constexpr const char* folder_name = "states";
  static constexpr const char* record_name = "states.json";
  static constexpr const char* checkpoint_name = "checkpoint.npz";

  StateStore(std::filesystem::path folder, const Scene& scene, const StepChoice& choice, int particles);

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path file(double moment) const;

  /// How far a store has come.
  struct Record {
    RunFacts facts;
    long frames = 0;         // 1 to this are there
    bool finished = false;   // they are all that the run has, of its scene's duration
    std::string divergence;  // where it ended early; else empty
  };

  /// Whether there is a record of this scene's motion. Throws InputError when the store is of another motion, step or
  /// version.
  bool holds_this_run() const;
  /// Throws InputError where there is none.
  Record read_record() const { return read_record(folder_); }
  static Record read_record(const std::filesystem::path& folder);
  void write_record(const Record& record) const;

  bool has(double moment) const;
  /// Throws InputError when it is missing, damaged or of another number of particles.
  sim::WatchedRun::Sample read(double moment) const;
  void write(const sim::WatchedRun::Sample& sample) const;

  std::optional<sim::WatchedRun::Checkpoint> read_checkpoint() const;
  void write_checkpoint(const sim::WatchedRun::Checkpoint& checkpoint) const;

 private:
  const Eigen::MatrixXd& sized(const Eigen::MatrixXd& field, const std::filesystem::path& file) const;

  std::filesystem::path folder_;
  std::string motion_hash_;
  double fps_, step_;
  int particles_;
};

/// Throws InputError when `run`, a folder of a run, holds no states. Changes nothing.
void check_stored_states(const std::filesystem::path& run);

/// Throws InputError where a store, whose record that is, has not all frames that its scene wants, nor diverged.
void check_stored_frames(const std::filesystem::path& folder, const StateStore::Record& record, long wanted);

/// Removes the store's files from `folder`, and the folder when nothing else is in it.
void remove_states(const std::filesystem::path& folder);

}  // namespace billow::cli
