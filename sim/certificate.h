// The largest stable step of a scheme with a filter, found by running the real linearised step.
#pragma once

#include <cstdint>
#include <optional>

#include "sim/filter.h"
#include "sim/integrator.h"
#include "sim/stiffness.h"
#include "sim/structure.h"

namespace billow::sim {

struct CertificateOptions {
  double growth_tolerance = 1e-3;  // a step whose spectral radius is at most 1 plus this counts as stable
  double step_tolerance = 5e-4;    // relative width of the final bisection interval
  int steps = 1000;                // linear steps per trial
  std::uint64_t seed = 1;
};

/// What a search for the largest stable step found.
struct CertifiedStep {
  double step = 0.0;       // [s] largest step found stable; 0 when every step grows
  bool unlimited = false;  // stable at every step tried; `step` is then the largest one tried
  int trials = 0;
};

/// The largest h for which the linearised step x, v -> scheme(force = -K x - C v, filter) does not grow: its spectral
/// radius is at most 1 + growth_tolerance. Trials run the real scheme and filter from the stiffest mode plus noise;
/// growth is measured over a trial's second half, so that the linear growth of a double eigenvalue on the unit circle
/// does not count. The search climbs from a twentieth of 2/sqrt(k0) and bisects the first failure.
/// `linearisation` is about `position` (n x 3), where the filter takes its current distances. `filter` may be null.
CertifiedStep certified_step(const Structure& structure, const Linearisation& linearisation,
                             const Eigen::MatrixX3d& position, Method method, const IntegratorOptions& options,
                             const Filter* filter, const CertificateOptions& certificate = {});

}  // namespace billow::sim
