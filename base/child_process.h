// Another program, run without a shell.
#pragma once

#include <string>
#include <vector>

namespace billow {

struct ProgramResult {
  bool found = true;
  bool timed_out = false;
  int status = 0;      // exit status, or 128 and the signal that ended it
  std::string errors;  // what it wrote to stderr, at most 64 KiB
};

/// Runs `words[0]`, looked up in PATH, with `input` at its stdin and its stdout discarded; ends it after `seconds`.
/// Throws std::system_error when no process can be started at all.
ProgramResult run_program(const std::vector<std::string>& words, const std::string& input, double seconds);

}  // namespace billow
