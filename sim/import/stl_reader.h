// STL files as text.
#pragma once

#include <string>

#include "sim/import/mesh_import.h"

namespace billow::sim {

/// Whether an STL file of these bytes is text: it begins with "solid" and is not as long as its count of triangles
/// would make a binary one.
bool is_text_stl(const std::string& bytes);

/// Throws InputError where a binary STL file does not hold the triangles that it claims.
void check_binary_stl(const std::string& bytes, const ImportLimits& limits);

/// Reads a text STL file in double precision; solids with a name are groups. Throws InputError with the line.
PolygonSoup read_text_stl(std::string bytes, const ImportLimits& limits);

}  // namespace billow::sim
