// Particles -> rows.
#include "cli/run/strip_rows.h"

#include <numeric>

namespace billow::cli {
StripRows::StripRows(const Scene& scene, const sim::Structure& structure) {
  if (!scene.strip) return;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    BodyRows rows = rows_of(scene.bodies[b], scene.strip->order);
    for (int& particle : rows.particles) particle += structure.body[b].first_particle;
    rows_ += static_cast<int>(rows.weight.size() > 0 ? rows.weight.rows()
                                                     : static_cast<Eigen::Index>(rows.particles.size()));
    part_.push_back(std::move(rows));
  }
}

Eigen::MatrixX3d StripRows::of(const Eigen::MatrixX3d& velocity) const {
  Eigen::MatrixX3d rows(rows_, 3);
  Eigen::Index row = 0;
  for (const BodyRows& part : part_) {
    const Eigen::MatrixX3d own = velocity(part.particles, Eigen::all);
    const Eigen::MatrixX3d shown = part.weight.size() > 0 ? Eigen::MatrixX3d(part.weight * own) : own;
    rows.middleRows(row, shown.rows()) = shown;
    row += shown.rows();
  }
  return rows;
}

std::vector<int> StripRows::order() const {
  std::vector<int> order(static_cast<std::size_t>(rows_));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

}  // namespace billow::cli
