// The springs' stiffness at the stiffest shape.
#pragma once

#include <Eigen/SparseCore>

#include "sim/body/structure.h"

namespace billow::sim {

/// L = sum k (e_i - e_j)(e_i - e_j)^T (n x n) [N/m], k the steepest slope of each spring's law: L times the identity in
/// space bounds the springs' K at every shape, as a spring's stiffness across is below that along it.
Eigen::SparseMatrix<double, Eigen::RowMajor> spring_bound(const Structure& structure);

}  // namespace billow::sim
