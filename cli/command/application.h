// From command line to exit status.
#pragma once

#include <string_view>

namespace billow::cli {

/// What the tool's exit status means; the same for every command.
enum ExitStatus {
  exit_done = 0,
  exit_internal_fault = 1,
  exit_usage = 2,
  exit_images_differ = 3,
  exit_bad_input = 4,
  exit_diverged = 5,
  exit_not_written = 6,
};

/// Parses the arguments, runs the command, turns every error into one message on stderr and an exit status
/// (128 + signal when a signal stopped the run). `commit` is the one that the tool was built from, or empty.
int run(int argc, char** argv, std::string_view commit);

}  // namespace billow::cli
