// Another program, run without a shell.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace billow {

struct ProgramResult {
  bool found = true;
  bool timed_out = false;
  bool stopped = false;  // by its watcher
  int status = 0;        // exit status, or 128 and the signal that ended it
  std::string output;    // what it wrote to stdout
  std::string errors;    // what it wrote to stderr, at most 64 KiB
};

/// Is shown the end of what a program has written to stdout until now, at most 4 KiB, many times a second. False ends
/// the program.
using ProgramWatcher = std::function<bool(std::string_view output)>;

/// Runs `words[0]`, looked up in PATH, with `input` at its stdin; ends it after `seconds`, which may be infinite, or
/// when `watcher`, if there is one, says so. It works in `folder`, or here where none is given. Throws
/// std::system_error when no process can be started at all.
ProgramResult run_program(const std::vector<std::string>& words, const std::string& input, double seconds,
                          const ProgramWatcher& watcher = {}, const std::string& folder = "");

/// This process becomes the program `words[0]`, looked up in PATH: it works in `folder` with the signals that a shell
/// would give it, and SIGALRM ends it after `seconds`. Throws std::system_error where it cannot be started.
[[noreturn]] void become_program(const std::vector<std::string>& words, const std::string& folder, unsigned seconds);

}  // namespace billow
