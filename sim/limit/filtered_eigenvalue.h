// The paper's Algorithm 1.
#pragma once

#include "sim/filter/filter.h"
#include "sim/linear/power_method.h"

namespace billow::sim {

/// The paper's Algorithm 1: the spectral radius alpha of F M^-1 K, F one application of `filter` at rest.
EigenvalueEstimate filtered_eigenvalue(const Structure& structure, const StiffnessMatrix& stiffness,
                                       const Filter& filter, const PowerOptions& options = {});

}  // namespace billow::sim
