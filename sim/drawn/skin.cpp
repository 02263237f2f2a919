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

SurfaceState pose(const Skin& skin, const Body& body, const State& state) {
  const SurfaceState particles{state.position.middleRows(body.first_particle, body.particles).cast<float>(),
                               state.velocity.middleRows(body.first_particle, body.particles).cast<float>()};
  if (skin.middle.size() == 0) return particles;
  SurfaceState points{skin.middle * particles.position, skin.middle * particles.velocity};
  add_along(skin.up, skin.height, particles, points);
  add_along(skin.side, skin.width, particles, points);
  return points;
}

Eigen::VectorXf strain(const Skin& skin, const Structure& structure, const Body& body, const State& state) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(body.particles), springs = sum;
  for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
    if (structure.kind[s] != SpringKind::structural) continue;
    const int a = structure.spring(s, 0), b = structure.spring(s, 1);
    const double length = (state.position.row(b) - state.position.row(a)).norm();
    for (const int particle : {a, b}) {
      sum(particle - body.first_particle) += std::abs(length / structure.rest_length(s) - 1.0);
      springs(particle - body.first_particle) += 1.0;
    }
  }
  const Eigen::VectorXf particles = (sum.array() / springs.array().max(1.0)).matrix().cast<float>();
  if (skin.middle.size() == 0) return particles;
  return skin.middle * particles;
}

}  // namespace billow::sim
