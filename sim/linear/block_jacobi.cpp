// Inverses of symmetric 3 x 3 blocks, all at once.
#include "sim/linear/block_jacobi.h"

namespace billow::sim {

// By cofactors, column by column: the inverse of [a d e; d b f; e f c].
void BlockJacobi::set(const StiffnessMatrix& matrix) {
  matrix.diagonal_blocks(straight_, mixed_);
  for (Eigen::Index i = 0; i < straight_.rows(); ++i) {
    const double a = straight_(i, 0), b = straight_(i, 1), c = straight_(i, 2);
    const double d = mixed_(i, 0), e = mixed_(i, 1), f = mixed_(i, 2);
    const double bc = b * c - f * f, ef = e * f - c * d, df = d * f - b * e;
    const double scale = 1.0 / (a * bc + d * ef + e * df);
    straight_.row(i) << scale * bc, scale * (a * c - e * e), scale * (a * b - d * d);
    mixed_.row(i) << scale * ef, scale * df, scale * (d * e - a * f);
  }
}

void BlockJacobi::apply(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) const {
  const auto xx = straight_.col(0).array(), yy = straight_.col(1).array(), zz = straight_.col(2).array();
  const auto xy = mixed_.col(0).array(), xz = mixed_.col(1).array(), yz = mixed_.col(2).array();
  const auto x0 = x.col(0).array(), x1 = x.col(1).array(), x2 = x.col(2).array();
  y.resize(x.rows(), 3);
  y.col(0) = (xx * x0 + xy * x1 + xz * x2).matrix();
  y.col(1) = (xy * x0 + yy * x1 + yz * x2).matrix();
  y.col(2) = (xz * x0 + yz * x1 + zz * x2).matrix();
}

}  // namespace billow::sim
