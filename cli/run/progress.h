// How far a command is, on stderr, and how long its phases took.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/words.h"
#include "cli/text/terminal.h"

namespace billow::cli {

/// `automatic` is one redrawn line on a terminal and plain lines elsewhere; `json` is one object per line; `none`
/// leaves errors alone.
enum class ProgressStyle { automatic, plain, json, none };
Words<ProgressStyle> words(ProgressStyle);

/// How what a command says besides is said in that style.
Remarks remarks_of(ProgressStyle style);

/// Of several pieces of work that are each done by themselves, one that has ended.
struct EndedPiece {
  std::string_view stage;  // what they are: "runs"
  std::size_t done = 0, total = 0;
  std::string name;    // the piece's
  std::string status;  // a word
  std::string how;     // "in 2.1 s"
};
/// "[3/12] run 7, rk4: done in 2.1 s", or that as an object, as choose_remarks has it.
void say_ended(const EndedPiece& piece);

/// A phase of a command, all its pieces together.
struct PhaseTime {
  std::string name;
  double seconds = 0.0;  // [s] of the wall clock
};

/// Prints a command's progress and adds up its phases, which follow one another without gaps. Use it from one thread.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  /// `begin` is where the wall clock's time counts from; up to the first phase it is a phase of its own, "start".
  explicit Progress(ProgressStyle style, Clock::time_point begin = Clock::now());
  ~Progress() { end(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Ends the phase before and begins `name`, at work on `subject`, if it is on anything. It is said when it lasts
  /// longer than half a second.
  void phase(std::string_view name, std::string_view subject = "");
  /// [s] that the phases of this name took until now; 0 where there was none.
  double seconds(std::string_view phase) const;
  /// All phases until now, in the order in which they first began.
  std::vector<PhaseTime> phases() const;
  /// [s] from the beginning until now: the sum of all phases.
  double wall() const;

  /// Starts a stage of `total` frames, which says itself how far it is.
  void begin(std::string_view stage, long total);
  /// `done` frames of the stage are finished, up to simulated time `time` [s].
  void update(long done, double time);
  /// A line of its own, before or after a stage; with `json` an object {"message": …} like every other line.
  void say(const std::string& line);
  /// Nothing more is shown of the stage or phase: a redrawn line is wiped.
  void end();

 private:
  void print_line(long done, double time);
  std::string announcement(std::string_view name, std::string_view subject) const;

  ProgressStyle style_;
  bool redraw_ = false;
  std::string stage_;
  long total_ = 0;
  Clock::time_point begin_, last_;             // of the stage of frames
  Clock::time_point start_, phase_begin_;      // of the command, of its present phase
  std::vector<PhaseTime> past_ = {{"start"}};  // without the present one's time since phase_begin_
  std::size_t present_ = 0;                    // of past_
};

}  // namespace billow::cli
