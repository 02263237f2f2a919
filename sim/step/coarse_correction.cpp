// Down, a small dense solve, and up.
#include "sim/step/coarse_correction.h"

#include <utility>

#include "sim/filter/filter_operator.h"
#include "sim/pass/level_transfer.h"

namespace billow::sim {

CoarseCorrection::CoarseCorrection(const Structure& structure, const Body& body, NodeLevel level)
    : first_particle_(body.first_particle),
      particles_(body.particles),
      level_(std::move(level)),
      sums_(structure, body, level_),
      free_(structure.inverse_mass.segment(body.first_particle, body.particles).cwiseSign()),
      nodes_(4 * static_cast<std::size_t>(level_.nodes())),
      packed_(3 * level_.nodes()) {}

void CoarseCorrection::set(const StiffnessMatrix& matrix) {
  if (!factor_) factor_.emplace();
  factor_->compute(sums_.sum(matrix));
}

void CoarseCorrection::add(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
  if (!factor_ || factor_->info() != Eigen::Success) return;
  const LevelParticles body{level_, first_particle_, particles_};
  const FilterColumns from{{x.col(0).data(), x.col(1).data(), x.col(2).data()}, {}};
  particles_to_nodes(body, from, free_, fine_, nodes_.data(), scratch_);
  solve_at_nodes();
  nodes_to_particles(body, nodes_.data(), 1.0, columns_of(y, y), scratch_);
}

void CoarseCorrection::solve_at_nodes() {
  const int count = level_.nodes();
  Eigen::Map<Eigen::Matrix4Xd, Eigen::Aligned64> rows(nodes_.data(), 4, count);
  packed_.reshaped(3, count) = rows.topRows<3>();
  factor_->solveInPlace(packed_);
  rows.topRows<3>() = packed_.reshaped(3, count);
}

}  // namespace billow::sim
