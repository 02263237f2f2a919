// The largest eigenvalue of a symmetric operator, with a bound on its error, by Lanczos's iteration.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "sim/linear/particle_operator.h"

namespace billow::sim {

/// B G, with B and G self-adjoint in the masses' inner product and G without negative eigenvalues: self-adjoint in the
/// inner product x . M G y. Both map vectors that are zero in the rows of pinned particles to such vectors.
struct SymmetricProduct {
  ParticleOperator outer;      // B
  ParticleOperator inner;      // G; empty: the identity
  Eigen::VectorXd inner_mass;  // (n) [kg] of the inner product; 0 for pinned particles
};

struct LanczosOptions {
  double tolerance = 1e-4;       // of the error bound, as a share of the largest eigenvalue's magnitude and of `scale`
  double scale = 0.0;            // what the eigenvalue is compared with: an eigenvalue near 0 need not be known better
  double stop_above = HUGE_VAL;  // an eigenvalue known to be above this need not be known better
  int max_iterations = 1000;
  std::uint64_t seed = 1;
};

/// An eigenvalue lies within `error` of `value`, and none is above `value` + `error` unless the seeded first vector
/// misses it.
struct ExtremeEigenvalue {
  double value = 0.0, error = 0.0;
  int iterations = 0;
  bool converged = false;
  /// What the eigenvalue does not exceed.
  double upper() const { return value + error; }
};

/// The largest (not: the largest in magnitude) eigenvalue of `product` (Golub & Van Loan, chapter 10). Its Ritz value
/// converges from below; the error bound is the residual's norm (their theorem 10.1.2 carried over to the inner
/// product). `vector`, if given, receives the eigenvector G x (n x 3), at the price of running twice.
ExtremeEigenvalue largest_eigenvalue(const SymmetricProduct& product, const LanczosOptions& options = {},
                                     Eigen::MatrixX3d* vector = nullptr);

}  // namespace billow::sim
