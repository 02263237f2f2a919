// Particles -> rows.
#include "cli/strip_rows.h"

#include <numeric>

#include "sim/fish_skin.h"
#include "sim/particle_order.h"

namespace billow::cli {
namespace {

constexpr int axis_rows = 64;

}  // namespace

StripRows::StripRows(const Scene& scene, const sim::Structure& structure) {
  if (!scene.strip) return;
  const bool ordered = scene.strip->order == StripOrder::zigzag;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const sim::Body& body = structure.body[b];
    const bool fish = scene.bodies[b].fish.has_value();
    Part part;
    part.particles.resize(body.particles);
    std::iota(part.particles.begin(), part.particles.end(), 0);
    if (ordered && fish) part.weight = sim::fish_axis(axis_rows);
    if (ordered && !fish) part.particles = sim::zigzag_order(scene.bodies[b].mesh);
    for (int& particle : part.particles) particle += body.first_particle;
    rows_ += static_cast<int>(part.weight.size() > 0 ? part.weight.rows() : body.particles);
    part_.push_back(std::move(part));
  }
}

Eigen::MatrixX3d StripRows::of(const Eigen::MatrixX3d& velocity) const {
  Eigen::MatrixX3d rows(rows_, 3);
  Eigen::Index row = 0;
  for (const Part& part : part_) {
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
