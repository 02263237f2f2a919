// Down, a small dense solve, and up.
#include "sim/step/coarse_correction.h"

#include <utility>

#include "sim/pass/level_pass.h"

namespace billow::sim {

CoarseCorrection::CoarseCorrection(const Structure& structure, const Body& body, NodeLevel level)
    : first_particle_(body.first_particle),
      particles_(body.particles),
      level_(std::move(level)),
      sums_(structure, body, level_),
      free_(Eigen::VectorXd::Ones(body.particles)),
      fine_(level_.grid ? 0 : 4 * static_cast<std::size_t>(body.particles)),
      nodes_(4 * static_cast<std::size_t>(level_.nodes())),
      packed_(3 * level_.nodes()) {
  for (int i = 0; i < particles_; ++i)
    if (structure.pinned(first_particle_ + i)) free_(i) = 0.0;
}

void CoarseCorrection::set(const StiffnessMatrix& matrix) { factor_.compute(sums_.sum(matrix)); }

void CoarseCorrection::add(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
  if (factor_.info() != Eigen::Success) return;
  restrict_to_nodes(x);
  solve_at_nodes();
  add_interpolated(y);
}

void CoarseCorrection::restrict_to_nodes(const Eigen::MatrixX3d& x) {
  const FilterColumns columns{{x.col(0).data(), x.col(1).data(), x.col(2).data()}, {}};
  if (level_.grid)
    return restrict_grid(*level_.grid, columns, first_particle_, free_.data(), nodes_.data(), 0,
                         level_.grid->down.nodes(), scratch_);
  put_momenta(columns, first_particle_, free_.data(), fine_.data(), 0, particles_);
  restrict_rows(level_.restriction, fine_.data(), nodes_.data(), 0, level_.nodes());
}

void CoarseCorrection::solve_at_nodes() {
  const int count = level_.nodes();
  Eigen::Map<Eigen::Matrix4Xd, Eigen::Aligned64> rows(nodes_.data(), 4, count);
  packed_.reshaped(3, count) = rows.topRows<3>();
  factor_.solveInPlace(packed_);
  rows.topRows<3>() = packed_.reshaped(3, count);
}

void CoarseCorrection::add_interpolated(Eigen::MatrixX3d& y) {
  double *const x0 = y.col(0).data(), *const x1 = y.col(1).data(), *const x2 = y.col(2).data();
  const FilterColumns columns{{x0, x1, x2}, {x0, x1, x2}};
  if (level_.grid)
    put_interpolated_grid(*level_.grid, level_.interpolation, nodes_.data(), 1.0, columns, first_particle_, 0,
                          level_.grid->down.fine(), scratch_);
  else
    put_interpolated(level_.interpolation, nodes_.data(), 1.0, columns, first_particle_, 0, particles_);
}

}  // namespace billow::sim
