// A selection of rows.
#include "sim/body/needed_springs.h"

#include <utility>

namespace billow::sim {

Structure with_needed_springs(Structure structure) {
  std::vector<int> needed;
  std::vector<SpringKind> kind;
  for (int s = 0; s < structure.springs(); ++s) {
    if (!(structure.stiffness(s) > 0.0)) continue;
    needed.push_back(s);
    kind.push_back(structure.kind[s]);
  }
  structure.spring = structure.spring(needed, Eigen::all).eval();
  structure.rest_length = structure.rest_length(needed).eval();
  structure.stiffness = structure.stiffness(needed).eval();
  structure.damping = structure.damping(needed).eval();
  structure.kind = std::move(kind);
  structure.body.front().springs = structure.springs();
  return structure;
}

}  // namespace billow::sim
