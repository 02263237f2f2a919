// The largest eigenvalue in modulus of an operator that is not symmetric, by Arnoldi's iteration.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "sim/linear/particle_operator.h"

namespace billow::sim {

struct ArnoldiOptions {
  int dimension = 40;         // of the Krylov spaces
  int max_iterations = 2000;  // products
  double tolerance = 1e-7;    // of the residual, as a share of the modulus
  std::uint64_t seed = 1;
};

struct LargestModulus {
  double value = 0.0, residual = 0.0;
  int iterations = 0;
  bool converged = false;
};

/// The largest modulus of the eigenvalues of `multiply` on (n x 3) fields that are zero where `inner_mass` (n) is, from
/// Krylov spaces that are restarted from their best vector (Saad, "Numerical Methods for Large Eigenvalue Problems",
/// section 6.2.1).
LargestModulus largest_modulus(const ParticleOperator& multiply, const Eigen::VectorXd& inner_mass,
                               const ArnoldiOptions& options = {});

}  // namespace billow::sim
