// How far a moving structure is stretched.
#pragma once

#include "sim/body/state.h"
#include "sim/body/structure.h"

namespace billow::sim {

/// (l - L)/L over all structural springs, L being their rest length and l how long they are; negative where they are
/// shorter. A structure without structural springs, as a fish is, has 0.
struct Stretch {
  double largest = 0.0, mean = 0.0;
};
Stretch stretch_of(const Structure& structure, const State& state);

/// Of each particle (n): the mean of |l - L|/L over its structural springs; 0 where it has none.
Eigen::VectorXd strain_of(const Structure& structure, const State& state);

}  // namespace billow::sim
