// The largest step at which a scene's whole run behaves.
#pragma once

#include <optional>

#include "cli/scene/simulation.h"
#include "sim/limit/measured_limit.h"

namespace billow::cli {

/// Bisects on whole runs of the scene from `initial`, pins held still as in `phase`, with `method` and `filter` (none:
/// unfiltered), looking first near `certified` [s], or near the limit that `k0` [1/s^2] sets where there is none.
sim::MeasuredStep measure_step(const Scene& scene, const Simulation::Phase& phase, const sim::State& initial,
                               sim::Method method, const std::optional<sim::FilterOptions>& filter,
                               std::optional<double> certified, double k0);

}  // namespace billow::cli
