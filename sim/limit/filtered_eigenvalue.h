// The paper's Algorithm 1.
#pragma once

#include "sim/filter/filter.h"
#include "sim/linear/max_eigenvalue.h"

namespace billow::sim {

/// The paper's Algorithm 1: the spectral radius alpha of F M^-1 K, F one application of `filter` at rest. The paper
/// finds it by power iteration; Krylov spaces find the same number (on the drape in 20 products).
EigenvalueEstimate filtered_eigenvalue(const Structure& structure, const StiffnessMatrix& stiffness,
                                       const Filter& filter,
                                       const EigenvalueOptions& options = {.max_iterations = 400, .tolerance = 1e-6});

}  // namespace billow::sim
