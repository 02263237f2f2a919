// How much of every level a filter takes.
#pragma once

#include <vector>

#include "sim/body/structure.h"
#include "sim/filter/level_filter.h"

namespace billow::sim {

/// Sets the weakest shares of every body with lambda_max(F M^-1 L) <= lambda_max(M^-1 L) / ratio^2 = R, where
/// L = sum k (e_i - e_j)(e_i - e_j)^T bounds the springs' stiffness at every shape, k the steepest slope of each
/// spring's law: a step `ratio` times the unfiltered one is stable then, whatever the shape. A body that is soft enough
/// as it is is not filtered.
///
/// Let rho_l = lambda_max(Q_l M^-1 L). The last level that takes part is the first with rho < 0.9 R; of the levels
/// before it gamma_l = a R / rho_l, the last gets the rest, and a is as large as R allows. Where
/// that leaves nothing to the last, F is mixed with the identity instead.
///
/// Throws InputError on a ratio below 1, or one that the coarsest level of a body does not reach.
void find_level_shares(const Structure& structure, double ratio, std::vector<LevelSum>& bodies);

}  // namespace billow::sim
