// One polygon of a mesh.
#pragma once

#include <array>

namespace billow::sim {

/// One polygon: three or four corners, counter-clockwise seen from outside; a triangle's last entry is -1.
using Face = std::array<int, 4>;

/// Number of corners of a face (3 or 4).
inline int corner_count(const Face& face) { return face[3] < 0 ? 3 : 4; }

}  // namespace billow::sim
