// The linear system of an implicit step: conjugate gradient as long as what it leaves unsolved does no harm, else
// sparse Cholesky.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/linear/conjugate_gradient.h"
#include "sim/step/integrator.h"

namespace billow::sim {

/// A = M + h C + h^2 K as its scheme knows it: M the masses, C and K symmetric without a negative eigenvalue.
class ImplicitMatrix {
 public:
  virtual ~ImplicitMatrix() = default;
  /// y (n x 3) = A x, rows of pinned particles as ordinary ones.
  virtual void multiply(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) const = 0;
  /// y (n x 3) = x times something positive definite that is near the inverse of A.
  virtual void precondition(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) const = 0;
  /// x (n x 3) = A^-1 b, rows and columns of pinned particles replaced by the identity. False where A is not positive
  /// definite to working precision; x may be anything then.
  virtual bool solve_directly(const Eigen::MatrixX3d& b, Eigen::MatrixX3d& x) = 0;
  /// Whether K holds only near the state that it was taken at, rather than bounding the forces' slopes everywhere.
  virtual bool linearised() const = 0;
};

/// Solves one step after another. Pinned particles keep their velocity.
class ImplicitSolve {
 public:
  ImplicitSolve(const Structure& structure, const IntegratorOptions& options, ImplicitMatrix& matrix);
  ImplicitSolve(const ImplicitSolve&) = delete;
  ImplicitSolve& operator=(const ImplicitSolve&) = delete;

  /// The new velocity (n x 3) = old + dv with A dv = b, what A and b are now. Rows of pinned particles in b become
  /// zero.
  void solve(const Eigen::MatrixX3d& old, Eigen::MatrixX3d& b, Eigen::MatrixX3d& velocity);

  /// The first guess of the next solve knows nothing of those before.
  void forget() { previous_change_.setZero(), change_.setZero(); }

  const SolveCounts& counts() const { return counts_; }

 private:
  void zero_pinned_rows(Eigen::MatrixX3d& field) const;
  bool solve_iteratively(const Eigen::MatrixX3d& old, const Eigen::MatrixX3d& b, Eigen::MatrixX3d& velocity);
  bool tighten(const Eigen::MatrixX3d& old, Eigen::MatrixX3d& velocity);
  // `change` is dv.M dv.
  bool rest_is_harmless(const Eigen::MatrixX3d& velocity);
  bool rest_is_small(double change, const Eigen::MatrixX3d& velocity) const;
  bool rest_adds_energy(double change, const Eigen::MatrixX3d& velocity);
  bool solve_directly(const Eigen::MatrixX3d& b);

  const Structure& structure_;
  const IntegratorOptions options_;
  ImplicitMatrix& matrix_;
  LinearSystem system_;  // matrix_ without its pinned rows
  std::vector<int> pinned_;
  Eigen::MatrixX3d previous_change_, change_, direct_change_, product_;  // (n x 3)
  ConjugateGradient gradient_;
  SolveCounts counts_;
};

}  // namespace billow::sim
