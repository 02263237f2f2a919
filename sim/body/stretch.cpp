// A pass over structural springs.
#include "sim/body/stretch.h"

#include <algorithm>
#include <cmath>

namespace billow::sim {

Stretch stretch_of(const Structure& structure, const State& state) {
  double largest = -INFINITY, sum = 0.0;
  int count = 0;
  for (int s = 0; s < structure.springs(); ++s) {
    if (structure.kind[s] != SpringKind::structural) continue;
    const int i = structure.spring(s, 0), j = structure.spring(s, 1);
    const double stretch = (state.position.row(j) - state.position.row(i)).norm() / structure.rest_length(s) - 1.0;
    largest = std::max(largest, stretch);
    sum += stretch;
    ++count;
  }
  return count > 0 ? Stretch{largest, sum / count} : Stretch{};
}

}  // namespace billow::sim
