// Which pairs of a closed mesh's vertices brace it from within.
#pragma once

#include <utility>
#include <vector>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// One vertex's ray through the inside, and the vertex that it is joined to.
struct InteriorRay {
  int from, to;
  bool straight;  // inwards; else at 45 degrees to that
};

/// From every vertex one ray goes straight inwards and four go at 45 degrees to it, and each joins the vertex to the
/// nearest corner of the face on which it first comes out. Ascending by `from`; the rays that come out nowhere are left
/// out. Moves, turns and scales with the mesh. `mesh` must be a solid (require_solid).
std::vector<InteriorRay> interior_rays(const Mesh& mesh);

/// Pairs of vertices (first < second, ascending, none twice) that a ray joins: they lie across the inside of the solid
/// from each other. So a sphere's vertices are joined to those opposite, and an arm is braced across and along.
std::vector<std::pair<int, int>> interior_pairs(const Mesh& mesh);

}  // namespace billow::sim
