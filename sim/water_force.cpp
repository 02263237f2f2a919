// Faces -> pressure.
#include "sim/water_force.h"

#include <Eigen/Geometry>

namespace billow::sim {
namespace {

// Half the cross product of the diagonals: A n of a flat quad, and of the mean of a bent quad's two triangulations.
Eigen::RowVector3d area_normal(const State& state, const Face& face) {
  const auto corner = [&](int c) -> Eigen::RowVector3d { return state.position.row(face[c]); };
  if (corner_count(face) == 3) return 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0));
  return 0.5 * (corner(2) - corner(0)).cross(corner(3) - corner(1));
}

}  // namespace

WaterForce::WaterForce(const Water& water, const std::vector<Face>& faces, int first_particle)
    : water_(water), face_(faces) {
  for (Face& face : face_)
    for (int c = 0; c < corner_count(face); ++c) face[c] += first_particle;
}

void WaterForce::add_force(const State& state, Eigen::MatrixX3d& force) const {
  for (const Face& face : face_) {
    const int corners = corner_count(face);
    Eigen::RowVector3d velocity = Eigen::RowVector3d::Zero();
    for (int c = 0; c < corners; ++c) velocity += state.velocity.row(face[c]) / corners;
    velocity -= water_.velocity.transpose();
    const Eigen::RowVector3d normal = area_normal(state, face);
    const double area = normal.norm();
    const double outflow = normal.dot(velocity);  // A (n . v) [m^3/s]
    if (outflow <= 0.0 || area == 0.0) continue;
    const Eigen::RowVector3d share = -water_.resistance * outflow / (area * corners) * normal;
    for (int c = 0; c < corners; ++c) force.row(face[c]) += share;
  }
}

void Buoyancy::add_force(const State&, Eigen::MatrixX3d& force) const {
  for (int axis = 0; axis < 3; ++axis)
    force.col(axis).segment(body_.first_particle, body_.particles) +=
        lift_(axis) * structure_.mass.segment(body_.first_particle, body_.particles);
}

double Buoyancy::energy(const State& state) const {
  return -structure_.mass.segment(body_.first_particle, body_.particles)
              .dot(state.position.middleRows(body_.first_particle, body_.particles) * lift_);
}

}  // namespace billow::sim
