// Polygons as bytes, to hand them from the importing process to the tool.
#pragma once

#include <string>
#include <string_view>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// The soup as bytes for `decode_soup` on the same machine.
std::string encode_soup(const PolygonSoup& soup);

/// The soup in `bytes`, which come from a process that a hostile file may have taken over: every count is checked
/// against what is there and every index against what it points into. Throws InputError when they do not agree.
PolygonSoup decode_soup(std::string_view bytes);

}  // namespace billow::sim
