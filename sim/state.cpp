// The state at rest, and moving.
#include "sim/state.h"

#include "sim/parallel.h"

namespace billow::sim {

namespace {

constexpr int least_part = 2048;  // particles

}  // namespace

State rest_state(const Structure& structure) {
  return {structure.rest_position, Eigen::MatrixX3d::Zero(structure.particles(), 3), 0.0};
}

void move(State& state, double h) {
  for_each_range(static_cast<int>(state.position.rows()), 1, least_part, [&](int begin, int end) {
    state.position.middleRows(begin, end - begin) += h * state.velocity.middleRows(begin, end - begin);
  });
}

}  // namespace billow::sim
