// The preconditioner of backward Euler.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/linear/block_jacobi.h"
#include "sim/step/coarse_correction.h"

namespace billow::sim {

/// Block Jacobi and, as long as solves take many iterations, what is smooth on each body by its coarse matrix (Bramble,
/// Pasciak & Xu 1990, with one level above the particles): block Jacobi alone hands what happens at one end of a sheet
/// to the other spring by spring. When the coarse matrices are used and renewed depends on how many iterations and
/// steps went before, and on nothing else.
class TwoLevel {
 public:
  explicit TwoLevel(const Structure& structure) : structure_(structure) {}
  /// Takes a positive definite `matrix`, after a solve that took `iterations`.
  void set(const StiffnessMatrix& matrix, long iterations);
  /// As if no solve had gone before.
  void forget() { used_ = false, age_ = 0; }
  /// y (n x 3) = something near A^-1 times x (n x 3).
  void apply(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y);

 private:
  void choose(long iterations);
  void build();

  const Structure& structure_;
  BlockJacobi blocks_;
  std::vector<CoarseCorrection> coarse_;  // of bodies large enough
  bool built_ = false, used_ = false;
  int age_ = 0;  // [step] of the coarse matrices
};

}  // namespace billow::sim
