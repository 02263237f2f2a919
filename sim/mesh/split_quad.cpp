// Comparing two diagonals.
#include "sim/mesh/split_quad.h"

#include <algorithm>

namespace billow::sim {

namespace {

// A diagonal must be shorter than the other by more than rounding to win; a square's is chosen by vertex number.
constexpr double diagonal_margin = 1e-6;

}  // namespace

int split_corner(const Face& quad, const std::array<Eigen::Vector3d, 4>& corner) {
  const double even = (corner[2] - corner[0]).norm(), odd = (corner[3] - corner[1]).norm();
  if (even < odd * (1.0 - diagonal_margin)) return 0;
  if (odd < even * (1.0 - diagonal_margin)) return 1;
  return static_cast<int>(std::min_element(quad.begin(), quad.end()) - quad.begin()) % 2;
}

}  // namespace billow::sim
