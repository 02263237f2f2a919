// The state at rest, and moving.
#include "sim/body/state.h"

#include "base/parallel.h"

namespace billow::sim {

State rest_state(const Structure& structure) {
  return {structure.rest_position, Eigen::MatrixX3d::Zero(structure.particles(), 3), 0.0};
}

void move(State& state, double h) {
  for_each_range(static_cast<int>(state.position.rows()), 1, least_part_of_a_pass, [&](int, int begin, int end) {
    state.position.middleRows(begin, end - begin) += h * state.velocity.middleRows(begin, end - begin);
  });
}

}  // namespace billow::sim
