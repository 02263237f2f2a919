// A Jacobian of forces as small blocks between particles: K x without a matrix, and the matrix when one is wanted.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "sim/body/structure.h"
#include "sim/linear/stiffness_product.h"

namespace billow::sim {

/// `exact` is the true Jacobian, whether it is symmetric or not. `definite` is symmetric and has no negative
/// eigenvalue: what the implicit schemes and the certificate use. It drops the transverse part of compressed springs
/// (Choi & Ko 2002, section 4.3), and how damping and pressure turn with what they act along.
enum class JacobianForm { exact, definite };

/// A 3n x 3n matrix: a diagonal; for each spring i-j with unit vector u, the block B = a I + b u u^T at (i,i) and (j,j)
/// and -B at (i,j) and (j,i), laid out for vectors; and 3 x 3 blocks between any two particles. Symmetric if those are.
class StiffnessMatrix {
 public:
  explicit StiffnessMatrix(const Structure& structure);

  void add_diagonal(int particle, double value) { diagonal_(particle) += value; }
  /// The block of a spring of the structure: every law that adds to one gives it the same unit vector.
  void add_spring(int spring, const Eigen::Vector3d& direction, double isotropic, double along);
  /// entry (i, j) += block; i and j may be the same particle, and the same entry may be added to again.
  void add_block(int i, int j, const Eigen::Matrix3d& block);
  /// As for a spring between i and j: block at (i,i) and (j,j), -block at (i,j) and (j,i).
  void add_pair(int i, int j, const Eigen::Matrix3d& block);

  /// Everything zero again, its memory kept.
  void set_zero();
  /// Whether nothing but zeros has been added.
  bool is_zero() const;
  /// this *= weight.
  void scale(double weight);
  /// this += weight other, both linearised at the same state.
  void add_scaled(const StiffnessMatrix& other, double weight);

  /// out (n x 3) = A x, pinned particles included as ordinary rows.
  void multiply(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& out) const;
  /// The symmetric parts of the 3 x 3 blocks of the diagonal, a row for each particle: xx, yy, zz in `straight` (n x 3)
  /// and xy, xz, yz in `mixed` (n x 3).
  void diagonal_blocks(Eigen::MatrixX3d& straight, Eigen::MatrixX3d& mixed) const;
  /// B of a spring of the structure.
  Eigen::Matrix3d spring_block(int spring) const;
  /// What add_diagonal has added.
  const Eigen::VectorXd& diagonal() const { return diagonal_; }
  /// What add_block and add_pair have added, in that order: (i, j) += value.
  struct Block {
    int i = 0, j = 0;
    Eigen::Matrix3d value;
  };
  const std::vector<Block>& blocks() const { return block_; }
  /// The same matrix assembled, particle-major (row 3 i + axis); the pattern is the same for every state as long as the
  /// same blocks are added. Rows and columns of pinned particles are replaced by the identity when `eliminate_pins`.
  Eigen::SparseMatrix<double> assemble(bool eliminate_pins) const;
  /// As assemble, of the springs' isotropic parts and the diagonal alone: the (n x n) matrix that acts on every axis
  /// alike. Throws std::logic_error where there are other blocks.
  Eigen::SparseMatrix<double> assemble_one_axis(bool eliminate_pins) const;

 private:
  BlockColumns columns() const;
  void diagonal_without_blocks(Eigen::MatrixX3d& straight, Eigen::MatrixX3d& mixed) const;

  const Structure& structure_;
  std::shared_ptr<const ProductPlan> plan_;  // copies share it
  Eigen::VectorXd diagonal_;                 // (n)
  Eigen::MatrixX3d direction_;               // (m x 3) u, by the plan's slot, as are
  Eigen::VectorXd isotropic_;                // (m)     a
  Eigen::VectorXd along_;                    // (m)     b
  bool springless_ = true;                   // all springs' blocks are zero, as where only friction damps
  std::vector<Block> block_;                 // between any particles, in the order in which they were added
};

/// K and C of a structure: force = -K dx - C dv.
struct Linearisation {
  explicit Linearisation(const Structure& structure) : stiffness(structure), damping(stiffness) {}

  StiffnessMatrix stiffness, damping;
};

}  // namespace billow::sim
