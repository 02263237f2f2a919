// Where a run's states come from: the simulation, or what was kept of an earlier one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/step/watched_run.h"

namespace billow::cli {

/// What is known of how the states so far came about.
struct RunFacts {
  long steps = 0;
  double time = 0.0;  // [s] simulated
  sim::SolveCounts solves = {};
  std::vector<sim::Incident> incidents = {};  // what went wrong and was mended
  double largest_strain = 0.0;                // [rest lengths] of any spring
};

class StateSource {
 public:
  virtual ~StateSource() = default;
  /// The next state that the run is looked at in, or nothing at the end. Throws DivergenceError once all that came
  /// before is delivered.
  virtual std::optional<sim::WatchedRun::Sample> next() = 0;
  virtual RunFacts facts() const = 0;
};

}  // namespace billow::cli
