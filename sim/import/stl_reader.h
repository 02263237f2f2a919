// STL files as text.
#pragma once

#include "sim/import/mesh_import.h"

namespace billow::sim {

/// Whether the STL file is text: it begins with "solid" and is not as long as its count of triangles would make a
/// binary one.
bool is_text_stl(const std::filesystem::path& file);

/// Throws InputError where a binary STL file does not hold the triangles that it claims.
void check_binary_stl(const std::filesystem::path& file, const ImportLimits& limits);

/// Reads a text STL file in double precision; solids with a name are groups. Throws InputError with the line.
PolygonSoup read_text_stl(const std::filesystem::path& file, const ImportLimits& limits);

}  // namespace billow::sim
