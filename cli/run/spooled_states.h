// States that are kept on disk from the survey of a run to its film, so that nothing is simulated twice.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/spool.h"
#include "cli/run/state_source.h"

namespace billow::cli {

/// States in the order in which they were added, as long as they do not take up too much room.
class SpooledStates : public StateSource {
 public:
  static constexpr std::size_t most_bytes = std::size_t{4} << 30;

  /// Spools to the disk that `purpose` will lie on.
  explicit SpooledStates(const std::filesystem::path& purpose) : spool_(purpose) {}

  /// Once there is no room nothing more is kept.
  void add(const sim::WatchedRun::Sample& sample);
  /// Ends the adding: the facts of the run, and its divergence where it diverged.
  void close(RunFacts facts, std::optional<std::string> divergence);
  /// Whether all that was added is there.
  bool whole() const { return !full_; }

  std::optional<sim::WatchedRun::Sample> next() override;
  RunFacts facts() const override { return facts_; }

 private:
  Spool spool_;
  bool full_ = false;
  Eigen::Index particles_ = 0;
  std::size_t bytes_ = 0, read_ = 0;
  RunFacts facts_;
  std::optional<std::string> divergence_;
};

}  // namespace billow::cli
