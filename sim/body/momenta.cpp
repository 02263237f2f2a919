// Sums over particles.
#include "sim/body/momenta.h"

#include <Eigen/Geometry>

namespace billow::sim {

double kinetic_energy(const Structure& structure, const State& state) {
  double sum = 0.0;
  for (int i = 0; i < structure.particles(); ++i) sum += 0.5 * structure.mass(i) * state.velocity.row(i).squaredNorm();
  return sum;
}

Eigen::Vector3d linear_momentum(const Structure& structure, const State& state) {
  return state.velocity.transpose() * structure.mass;
}

Eigen::Vector3d angular_momentum(const Structure& structure, const State& state) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < structure.particles(); ++i) {
    const Eigen::Vector3d x = state.position.row(i), v = state.velocity.row(i);
    sum += structure.mass(i) * x.cross(v);
  }
  return sum;
}

}  // namespace billow::sim
