// How far a run is, on stderr.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace billow::cli {

/// `automatic` is one redrawn line on a terminal and plain lines elsewhere; `json` is one object per line.
enum class ProgressStyle { automatic, plain, json, none };

/// Prints a run's progress. Use it from one thread.
class Progress {
 public:
  explicit Progress(ProgressStyle style);

  /// Starts a stage of `total` frames.
  void begin(std::string_view stage, long total);
  /// `done` frames of the stage are finished, up to simulated time `time` [s].
  void update(long done, double time);
  /// A line of its own, before or after a stage; with `json` an object {"message": …} like every other line.
  void say(const std::string& line) const;
  /// Ends the stage: a redrawn line is wiped.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  void print_line(long done, double time);

  ProgressStyle style_;
  bool redraw_ = false;
  std::string stage_;
  long total_ = 0;
  Clock::time_point begin_, last_;
};

}  // namespace billow::cli
