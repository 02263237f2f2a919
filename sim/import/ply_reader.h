// PLY files: any elements with any properties in any order.
#pragma once

#include "sim/import/mesh_import.h"

namespace billow::sim {

/// Reads a PLY file (Turk 1994; text or binary of either byte order). Polygons come from lists called vertex_indices or
/// vertex_index of the elements face and tristrips, wherever these stand; texture coordinates from the vertices (u v,
/// s t) or from the faces' texcoord; colours from red green blue. Every other number of a vertex becomes a weight of
/// its name. Throws InputError with the reason, and in texts with the line.
PolygonSoup read_ply(const std::filesystem::path& file, const ImportLimits& limits);

}  // namespace billow::sim
