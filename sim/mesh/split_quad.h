// Where a quad is split into two triangles: the same for what is drawn and for what is touched.
#pragma once

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// The first corner, 0 or 1, of the shorter diagonal of `quad`, whose corners lie at `corner` [m]. Equal diagonals go
/// through the corner with the lowest number, so that a grid is split the same way everywhere, however its faces were
/// written.
int split_corner(const Face& quad, const std::array<Eigen::Vector3d, 4>& corner);

}  // namespace billow::sim
