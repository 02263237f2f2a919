// A flat view of a mesh that has no texture coordinates: which way is right, which way is up.
#pragma once

#include <Eigen/Core>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// Texture coordinates (v x 2) in [0, 1]^2: the bounding rectangle in the two axes in which the mesh extends most,
/// seen so that u points right and v up. Up is +y, or -z for a mesh that lies flat.
Eigen::MatrixX2d planar_uv(const Mesh& mesh);

}  // namespace billow::sim
