// k0 of the paper's equation 11, by power iteration.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "sim/body/structure.h"
#include "sim/linear/stiffness.h"

namespace billow::sim {

struct PowerOptions {
  int max_iterations = 20000;
  double tolerance = 1e-9;  // relative change of the estimate over one iteration
  std::uint64_t seed = 1;
};

struct EigenvalueEstimate {
  double value = 0.0;  // [1/s^2]
  int iterations = 0;
  bool converged = false;
};

/// k0, the largest eigenvalue of M^-1 K over the free particles. M^-1/2 K M^-1/2 is symmetric, so its Rayleigh quotient
/// converges twice as fast as the vector, and from below: callers keep a safety factor on the step. `mode`, if given,
/// receives the eigenvector (n x 3) in displacements.
EigenvalueEstimate max_eigenvalue(const Structure& structure, const StiffnessMatrix& stiffness,
                                  const PowerOptions& options = {}, Eigen::MatrixX3d* mode = nullptr);

/// Whether an iteration that went from `last` to `next` has come to rest.
bool settled(double next, double last, double tolerance);

}  // namespace billow::sim
