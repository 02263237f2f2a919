// k0 of the paper's equation 11.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "sim/body/structure.h"
#include "sim/linear/stiffness.h"

namespace billow::sim {

struct EigenvalueOptions {
  int max_iterations = 2000;
  double tolerance = 1e-7;  // of the error's bound, as a share of the eigenvalue
  std::uint64_t seed = 1;
};

struct EigenvalueEstimate {
  double value = 0.0;  // [1/s^2]
  int iterations = 0;
  bool converged = false;
  double error = 0.0;  // [1/s^2] bound of it; 0 where there is none
};

/// k0, the largest eigenvalue of M^-1 K over the free particles, by Lanczos's iteration. The value comes from below,
/// and is closer than the bound says by the square of it over the distance to the next eigenvalue. `mode`, if given,
/// receives the eigenvector (n x 3) in displacements.
EigenvalueEstimate max_eigenvalue(const Structure& structure, const StiffnessMatrix& stiffness,
                                  const EigenvalueOptions& options = {}, Eigen::MatrixX3d* mode = nullptr);

}  // namespace billow::sim
