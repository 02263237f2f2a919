// Step limits by eigenvalues, where a scheme's growth factors solve a real quadratic (docs/method.md, "Exact limits").
#pragma once

#include <optional>

#include "sim/limit/linearised_step.h"

namespace billow::sim {

/// The largest h up to which the linearised step does not grow, from the safe side of its eigenvalues' error bounds.
/// Nothing where there is no such closed form: for filters that are not self-adjoint in the masses' inner product, and
/// where forward Euler, RK4 or an implicit scheme filters velocities.
///
/// For any eigenvector of the step, let a, c and p >= 1 be its Rayleigh quotients of A = M^-1 K, C = M^-1 (damping) and
/// F^-1. Its growth factor then solves a quadratic whose coefficients must lie in the stability triangle:
///
///     FB Euler, Verlet, force filter or none   h^2 A + 2 h C <= 4 F^-1
///     FB Euler, Verlet, velocity filter        h^2 A + 2 h C <= 2 (F^-1 + I)
///     forward Euler, force filter or none      h A <= C,  2 h C <= 4 F^-1 + h^2 A
///     forward Euler, velocity filter           h^2 A <= h C + F^-1 - I,  2 h C <= 2 (F^-1 + I) + h^2 A: left to trials
///     RK4, force filter or none                z^2 + h c z + h^2 a = 0 inside RK4's region of stability
///     IMEX, no filter                          2 h C + h^2 K <= 4 M + 4 h C_L + 2 h^2 K_L, L what it takes implicitly
///     backward Euler, no filter                always
///
/// FB Euler's and Verlet's are necessary too, as is RK4's without damping; the others are where A and C commute.
std::optional<CertifiedStep> exact_limit(const LinearisedStep& step);

/// The same conditions with (F + F*) / 2 for a filter that is not self-adjoint: a guess of its limit, and a bound of it
/// for FB Euler and Verlet with a force filter, over all K and C that the given ones bound. Nothing where the mean has
/// negative responses.
std::optional<CertifiedStep> limit_of_mean_filter(const LinearisedStep& step);

/// Whether F has a negative eigenvalue, as plain weights can. With a force filter such a motion runs away whatever the
/// step; with a velocity filter it grows, by less a second the smaller the step.
bool turns_motions_around(const LinearisedStep& step);

}  // namespace billow::sim
