// How far a run is from one that is known to be right.
#pragma once

#include "cli/scene/scene.h"
#include "cli/scene/simulation.h"
#include "cli/study/study.h"

namespace billow::cli {

struct ReferenceError {
  double rms = 0.0;               // [m] of all particles' positions at all samples
  double worst = 0.0;             // [m] the largest root mean square of one sample
  double energy = 0.0;            // [J] kinetic and potential, at the end
  double reference_energy = 0.0;  // [J] of the reference then
};

/// Of `simulation`, stepped by `choice`, against `reference`, the same bodies by other means, every 0.05 s from the
/// start until `until` [s]. Throws InputError where `reference` has other particles, DivergenceError where either
/// diverges.
ReferenceError reference_error(const Simulation& simulation, const StepChoice& choice, const Simulation& reference,
                               double until);

}  // namespace billow::cli
