// What the reports on whole runs of scenes share.
#pragma once

#include <fmt/format.h>

#include <ctime>
#include <string>

namespace billow::bench {

/// [s] of the processor, by all threads of this process so far.
inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A report's command line: nothing, for run(false), or --json, for run(true). Returns the exit status.
template <class Run>
int report_main(int argc, char** argv, const Run& run) {
  const std::string option = argc > 1 ? argv[1] : "";
  if (argc > 2 || (!option.empty() && option != "--json")) {
    fmt::print(stderr, "usage: {} [--json]\n", argv[0]);
    return 2;
  }
  return run(option == "--json");
}

}  // namespace billow::bench
