// The sparse Cholesky factor of a matrix whose pattern hardly ever changes.
#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

namespace billow::sim {

class SparseCholesky {
 public:
  /// Factorises a symmetric `matrix`; what depends on its pattern alone is kept from the last one with the same. False
  /// where it is not positive definite to working precision: there is no factor then.
  bool factorise(const Eigen::SparseMatrix<double>& matrix);
  /// Whether there is a factor.
  bool ready() const { return ready_; }
  /// Needs a factor. Rows of `right` as the matrix's, any number of columns.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const { return factor_.solve(right); }

 private:
  bool same_pattern(const Eigen::SparseMatrix<double>& matrix) const;
  void analyse(const Eigen::SparseMatrix<double>& matrix);

  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
  std::vector<int> outer_, inner_;  // the pattern that has been analysed
  bool ready_ = false;
};

}  // namespace billow::sim
