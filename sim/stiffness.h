// The linearised springs as small blocks: K x without a matrix, and the matrix when one is wanted.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

#include "sim/stiffness_product.h"
#include "sim/structure.h"

namespace billow::sim {

/// `exact` is the true Jacobian, but for how projected damping turns with its spring, which isn't symmetric and
/// vanishes when the ends don't move relative to each other. `definite` drops the transverse part of compressed
/// springs, which would make the matrix indefinite: what the implicit schemes and the certificate use (Choi & Ko 2002,
/// section 4.3).
enum class JacobianForm { exact, definite };

/// A symmetric 3n x 3n matrix: a diagonal plus, for each spring i-j with unit vector u, the block
/// B = a I + b u u^T at (i,i) and (j,j) and -B at (i,j) and (j,i).
class StiffnessMatrix {
 public:
  explicit StiffnessMatrix(const Structure& structure);

  void add_diagonal(int particle, double value) { diagonal_(particle) += value; }
  void add_block(int spring, const Eigen::Vector3d& direction, double isotropic, double along);

  /// Everything zero again, its memory kept.
  void set_zero();
  /// this *= weight.
  void scale(double weight);
  /// this += weight other, both linearised at the same state.
  void add_scaled(const StiffnessMatrix& other, double weight);

  /// out (n x 3) = A x, pinned particles included as ordinary rows.
  void multiply(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& out) const;
  /// The 3 x 3 blocks of the diagonal, a row for each particle: xx, yy, zz in `straight` (n x 3) and xy, xz, yz in
  /// `mixed` (n x 3).
  void diagonal_blocks(Eigen::MatrixX3d& straight, Eigen::MatrixX3d& mixed) const;
  /// The same matrix assembled, particle-major (row 3 i + axis); the pattern is the same for every state. Rows and
  /// columns of pinned particles are replaced by the identity when `eliminate_pins`.
  Eigen::SparseMatrix<double> assemble(bool eliminate_pins) const;
  /// As assemble, of the isotropic parts alone: the (n x n) matrix that acts on every axis alike.
  Eigen::SparseMatrix<double> assemble_one_axis(bool eliminate_pins) const;

 private:
  BlockColumns columns() const;

  const Structure& structure_;
  std::shared_ptr<const ProductPlan> plan_;  // copies share it
  Eigen::VectorXd diagonal_;                 // (n)
  Eigen::MatrixX3d direction_;               // (m x 3) u, by the plan's slot, as are
  Eigen::VectorXd isotropic_;                // (m)     a
  Eigen::VectorXd along_;                    // (m)     b
  bool only_diagonal_ = true;                // all blocks are zero, as where only friction damps
};

/// K and C of a structure about one state: force = -K dx - C dv.
struct Linearisation {
  StiffnessMatrix stiffness, damping;
};

/// About rest, every spring with its full stiffness along itself, whichever way its model would let it go slack:
/// the stiffest that the structure can be at its rest shape.
Linearisation linearise_at_rest(const Structure& structure);

/// An upper bound over every shape: each spring with its steepest slope in all directions at once. While tensions stay
/// below k l, a spring's true block (T/l) I + (k - T/l) u u^T is at most k I whatever its direction, so no fold or
/// crumple of the structure is stiffer than this.
Linearisation linearise_any_shape(const Structure& structure);

}  // namespace billow::sim
