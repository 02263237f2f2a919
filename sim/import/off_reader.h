// OFF files, all their layouts.
#pragma once

#include "sim/import/mesh_import.h"

namespace billow::sim {

/// Reads Geomview's OFF: [ST][C][N][4][n]OFF, as text or BINARY, with or without its keyword. A text is a stream of
/// words; line ends matter only where faces have colours. Vertex colours may also stand in a plain OFF, and the count
/// of edges may be missing. Throws InputError with the line and the reason.
PolygonSoup read_off(const std::filesystem::path& file, const ImportLimits& limits);

}  // namespace billow::sim
