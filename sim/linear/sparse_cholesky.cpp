// Eigen's, analysed once a pattern.
#include "sim/linear/sparse_cholesky.h"

#include <algorithm>

namespace billow::sim {

bool SparseCholesky::factorise(const Eigen::SparseMatrix<double>& matrix) {
  if (!same_pattern(matrix)) analyse(matrix);
  factor_.factorize(matrix);
  return ready_ = factor_.info() == Eigen::Success;
}

bool SparseCholesky::same_pattern(const Eigen::SparseMatrix<double>& matrix) const {
  return std::equal(outer_.begin(), outer_.end(), matrix.outerIndexPtr(),
                    matrix.outerIndexPtr() + matrix.outerSize() + 1) &&
         std::equal(inner_.begin(), inner_.end(), matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
}

void SparseCholesky::analyse(const Eigen::SparseMatrix<double>& matrix) {
  factor_.analyzePattern(matrix);
  outer_.assign(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.outerSize() + 1);
  inner_.assign(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
}

}  // namespace billow::sim
