// Particles -> points.
#include "sim/skin.h"

namespace billow::sim {

SurfaceState pose(const Skin& skin, const Body& body, const State& state) {
  const Eigen::MatrixX3f position = state.position.middleRows(body.first_particle, body.particles).cast<float>();
  const Eigen::MatrixX3f velocity = state.velocity.middleRows(body.first_particle, body.particles).cast<float>();
  if (skin.weight.size() == 0) return {position, velocity};
  return {skin.weight * position, skin.weight * velocity};
}

}  // namespace billow::sim
