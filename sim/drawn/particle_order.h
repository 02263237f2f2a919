// The order in which a picture lists a mesh's particles.
#pragma once

#include <vector>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// The paper's Figure 3, from two dimensions to one: on a regular grid, row after row from the top, every other row
/// from right to left, so that neighbours in the picture are neighbours in the cloth. On any other mesh, along a
/// Hilbert curve over the texture square (or, without UVs, the plane of largest extent), which keeps the same property
/// as well as a line can.
std::vector<int> zigzag_order(const Mesh& mesh);

}  // namespace billow::sim
