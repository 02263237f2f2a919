// Sharp edges of a mesh that is drawn with smooth normals.
#pragma once

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// The mesh with its vertices doubled along every edge whose two faces turn by more than `angle` [rad], so that normals
/// averaged over a vertex's faces stay on one side of it. Faces, their order and texture coordinates are kept; vertex
/// colours and groups are not.
Mesh split_at_creases(const Mesh& mesh, double angle);

}  // namespace billow::sim
