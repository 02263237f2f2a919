// Runs of a study as child processes, several at a time: one that crashes takes no other down.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace billow::cli {

/// What a child came to: its exit status, or 128 and the signal that ended it.
struct JobEnd {
  int number = 0;  // of the run
  int status = 0;
  double seconds = 0.0;
};

/// Runs `command`, a `billow study …`, with `--only N` for every N in `numbers`, at most `jobs` at a time, each with
/// its output in `log_of(N)`, a new file in the place of what was there. `ended` is called as each ends. A signal to
/// this process is handed on to the children, and no more are started. Throws OutputError when a log cannot be written,
/// std::system_error when no process can be started.
void run_jobs(const std::vector<std::string>& command, const std::vector<int>& numbers, int jobs,
              const std::function<std::filesystem::path(int)>& log_of, const std::function<void(const JobEnd&)>& ended);

}  // namespace billow::cli
