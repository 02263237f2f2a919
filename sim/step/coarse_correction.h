// What a few smooth motions of a body add to a preconditioner.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>

#include "base/aligned.h"
#include "sim/levels/level_hierarchy.h"
#include "sim/linear/coarse_matrix.h"
#include "sim/pass/pass_scratch.h"

namespace billow::sim {

/// P (P^T A P)^-1 P^T: A's inverse among the motions that a level's nodes describe, through P, to one body.
class CoarseCorrection {
 public:
  CoarseCorrection(const Structure& structure, const Body& body, NodeLevel level);
  void set(const StiffnessMatrix& matrix);
  /// y (n x 3) += the correction times x (n x 3), once a matrix has been set.
  void add(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y);

 private:
  void solve_at_nodes();

  int first_particle_, particles_;
  NodeLevel level_;
  CoarseMatrix sums_;
  std::optional<Eigen::LLT<Eigen::MatrixXd>> factor_;  // none before the first matrix
  Eigen::VectorXd free_;                               // of the body's particles: 1, pinned ones 0
  AlignedVector<double> fine_, nodes_;                 // rows of x, y, z and a number that means nothing
  Eigen::VectorXd packed_;
  PassScratch scratch_;
};

}  // namespace billow::sim
