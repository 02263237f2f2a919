// The state at rest.
#include "sim/state.h"

namespace billow::sim {

State rest_state(const Structure& structure) {
  return {structure.rest_position, Eigen::MatrixX3d::Zero(structure.particles(), 3), 0.0};
}

}  // namespace billow::sim
