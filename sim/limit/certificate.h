// The largest stable step of a scheme with a filter, found by running the real linearised step.
#pragma once

#include <cstdint>

#include "sim/body/structure.h"
#include "sim/filter/filter.h"
#include "sim/linear/stiffness.h"
#include "sim/step/schemes.h"

namespace billow::sim {

struct CertificateOptions {
  int steps = 1000;  // linear steps per trial of an explicit scheme; half as many for schemes of several evaluations
  int implicit_steps = 24;       // of an implicit one, whose modes die out at once or grow at once
  double step_tolerance = 5e-4;  // relative width of the final bisection interval
  std::uint64_t seed = 1;

  /// A step whose spectral radius exceeds 1 by more than this counts as unstable. In half a trial it grows by e^2, and
  /// over e shows even where the growing motion begins as a small part of the whole. A trial of half as many steps
  /// comes to just under e: a radius of up to 1.0041 may pass there.
  double growth_tolerance() const { return 4.0 / steps; }
};

/// What a search for the largest stable step found.
struct CertifiedStep {
  double step = 0.0;       // [s] largest step found stable; 0 when even 0.08 of 2/sqrt(k0) grows
  bool unlimited = false;  // stable at every step tried; `step` is then the largest one tried
  int trials = 0;
};

/// The largest h for which the linearised step x, v -> scheme(force = -K x - C v, filter) does not grow. Trials run the
/// real scheme and filter from the stiffest mode plus noise, and compare the largest norm of the trial's last quarter
/// with that of its second: twofold at most for a double eigenvalue on the unit circle, so e counts as growth. The
/// search climbs from 0.4 of 2/sqrt(k0), or less where that grows, and bisects the first failure. `linearisation` is
/// about `position` (n x 3), where the filter takes its current distances. `filter` may be null.
CertifiedStep certified_step(const Structure& structure, const Linearisation& linearisation,
                             const Eigen::MatrixX3d& position, Method method, const IntegratorOptions& options,
                             const Filter* filter, const CertificateOptions& certificate = {});

}  // namespace billow::sim
