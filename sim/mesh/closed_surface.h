// What makes a mesh the skin of a solid: closed, oriented, in one piece.
#pragma once

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// Signed volume [m^3] inside the faces: positive when they face outwards. Quads count as split along corners 0 and 2.
double enclosed_volume(const Mesh& mesh);

/// Unit normals (v x 3) pointing out of the solid, area-weighted over each vertex's faces, whichever way they all face.
Eigen::MatrixX3d outward_normals(const Mesh& mesh);

/// Throws InputError, saying where and what to do, unless every edge joins exactly two faces that run along it in
/// opposite directions, the faces enclose a volume, and all hang together.
void require_solid(const Mesh& mesh);

}  // namespace billow::sim
