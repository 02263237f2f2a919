// The largest stable step of a scheme with a filter: by eigenvalues where they tell, by running the real linearised
// step where not.
#pragma once

#include <cstdint>

#include "sim/limit/linearised_step.h"

namespace billow::sim {

struct CertificateOptions {
  double tolerated_growth = 6.0;  // the logarithm of what a motion may grow by within the duration and count as stable
  double step_tolerance = 5e-4;   // relative width of the final bisection interval
  std::uint64_t seed = 1;
};

/// The largest h for which the linearised step does not grow; exact_limit's, where there is one.
///
/// Otherwise trials run the real scheme and filter from the stiffest mode plus noise and compare the largest energy of
/// the trial's last quarter with that of its second. What grows by less than e^6 over the run's whole duration counts
/// as stable; trials are as long as it takes to see that, within bounds set by the number of particles. The search
/// begins at the limit of the mean filter, (F + F*) / 2, if that has one, and else climbs from 0.4 of 2/sqrt(k0).
/// A filter whose weights change counts as the weakest and as the strongest that it becomes within the duration, and
/// where springs' current distances weigh, as none at all: stretched far enough they leave nothing of it.
///
/// `always_grows` is set where every step grows at about the same rate: it is the filter then that makes the motion
/// itself grow, as plain weights can, and `step` is the limit but for that.
CertifiedStep certified_step(const LinearisedStep& step, const CertificateOptions& options = {});

}  // namespace billow::sim
