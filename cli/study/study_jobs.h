// Runs of a study, or tests, as child processes, several at a time: one that crashes takes no other down.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace billow::cli {

/// What a child came to: its exit status, or 128 and the signal that ended it.
struct JobEnd {
  int number = 0;  // of the run
  int status = 0;
  double seconds = 0.0;
};

/// How a run's child is started.
struct JobCommand {
  std::vector<std::string> words;  // for this very program, its name first
  std::filesystem::path log;       // of what it writes to stdout and stderr; begun anew
};

/// Whether a run's turn has come.
enum class Turn {
  now,
  later,  // another process is at it: ask again
  past    // there is nothing to do any more
};

/// What run_jobs asks of the runs that it does.
class JobKeeper {
 public:
  virtual ~JobKeeper() = default;
  /// Asked before a run is started, at most twice a second.
  virtual Turn turn_of(int number) = 0;
  virtual JobCommand command_of(int number) = 0;
  /// Asked every few seconds while the run goes on; false: it is another process's now, so its child is ended and its
  /// turn asked for again.
  virtual bool goes_on(int number) = 0;
  virtual void ended(const JobEnd& end) = 0;
  /// Called when nothing is left but to wait for `others`, runs that other processes are at.
  virtual void waits(const std::vector<int>& others) = 0;
};

/// "exit status 4" or "ended by SIGKILL".
std::string described_end(int status);

/// The last line that a child left in its log: what it died of.
std::string last_words(const std::filesystem::path& log);

/// Does the runs `numbers` in their order, at most `jobs` at a time. No child outlives this call, however it ends, with
/// all that it has started, nor this process, even where that is killed. A signal to this process is handed on to the
/// children, and no more are started; those that do not end within `grace` are killed. Throws OutputError when a log
/// cannot be written, std::system_error when no process can be started, and what `keeper` throws.
void run_jobs(const std::vector<int>& numbers, int jobs, std::chrono::seconds grace, JobKeeper& keeper);

}  // namespace billow::cli
