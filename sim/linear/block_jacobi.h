// The preconditioner of backward Euler, or the finer half of it.
#pragma once

#include <Eigen/Core>

#include "sim/linear/stiffness.h"

namespace billow::sim {

/// Block Jacobi: the inverse of each particle's own 3 x 3 block. On the drape it saves a quarter of the iterations that
/// the diagonal alone needs, for little more work; incomplete Cholesky saves most of them and takes twice as long,
/// because its triangles cannot be solved a vector at a time (docs/performance.md).
class BlockJacobi {
 public:
  /// Takes the blocks of a positive definite `matrix`; memory is used again.
  void set(const StiffnessMatrix& matrix);
  /// y (n x 3) = inverse blocks times x (n x 3).
  void apply(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) const;

 private:
  Eigen::MatrixX3d straight_, mixed_;  // (n x 3) xx, yy, zz and xy, xz, yz of the inverse blocks
};

}  // namespace billow::sim
