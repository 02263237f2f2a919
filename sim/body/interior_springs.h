// Which pairs of a closed mesh's vertices brace it from within.
#pragma once

#include <utility>
#include <vector>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// Pairs of vertices (first < second, ascending, none twice) that lie across the inside of the solid from each other:
/// from every vertex one ray goes straight inwards and four go at 45 degrees to it, and each joins the vertex to the
/// nearest corner of the face on which it first comes out. So a sphere's vertices are joined to those opposite, and an
/// arm is braced across and along. Moves, turns and scales with the mesh. `mesh` must be a solid (require_solid).
std::vector<std::pair<int, int>> interior_pairs(const Mesh& mesh);

}  // namespace billow::sim
