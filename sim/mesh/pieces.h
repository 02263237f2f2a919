// What of a mesh hangs together.
#pragma once

#include <vector>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// The vertices (ascending) of each part of the mesh whose faces hang together, in the order of their first vertices.
std::vector<std::vector<int>> pieces(const Mesh& mesh);

}  // namespace billow::sim
