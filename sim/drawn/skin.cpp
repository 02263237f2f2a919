// Particles -> points.
#include "sim/drawn/skin.h"

#include <cmath>

namespace billow::sim {
namespace {

// point += length u / |u| and velocity += length d/dt (u / |u|), with d/dt (u / |u|) = (u' - e (e . u')) / |u|, e the
// unit vector of u.
void add_along(const Eigen::MatrixXf& weight, const Eigen::VectorXf& length, const SurfaceState& particles,
               SurfaceState& points) {
  const Eigen::MatrixX3f direction = weight * particles.position, change = weight * particles.velocity;
  for (Eigen::Index p = 0; p < direction.rows(); ++p) {
    const float size = direction.row(p).norm();
    if (size == 0.0f) continue;
    const Eigen::RowVector3f unit = direction.row(p) / size;
    points.position.row(p) += length(p) * unit;
    points.velocity.row(p) += length(p) / size * (change.row(p) - unit * unit.dot(change.row(p)));
  }
}

}  // namespace

SurfaceState pose(const Skin& skin, const Body& body, const State& state, const Eigen::Vector3d& origin) {
  const auto world = state.position.middleRows(body.first_particle, body.particles);
  const SurfaceState particles{(world.rowwise() - origin.transpose()).cast<float>(),
                               state.velocity.middleRows(body.first_particle, body.particles).cast<float>()};
  if (skin.middle.size() == 0) return particles;
  SurfaceState points{skin.middle * particles.position, skin.middle * particles.velocity};
  add_along(skin.up, skin.height, particles, points);
  add_along(skin.side, skin.width, particles, points);
  return points;
}

Eigen::VectorXf at_points(const Skin& skin, const Body& body, const Eigen::VectorXd& of_particles) {
  const Eigen::VectorXf of_body = of_particles.segment(body.first_particle, body.particles).cast<float>();
  return skin.middle.size() == 0 ? of_body : Eigen::VectorXf(skin.middle * of_body);
}

}  // namespace billow::sim
