// OBJ files and their material libraries.
#pragma once

#include "sim/import/mesh_import.h"

namespace billow::sim {

/// Reads a Wavefront OBJ file. Vertices are numbered as its `v` lines are: users pin them by these numbers. Groups are
/// the names of `g` (each word, and all of them as one where there are several), `o` and `usemtl`. Throws InputError,
/// with the line, on a number that is none (such as 1,5) or not finite, and on a face whose vertex does not exist.
PolygonSoup read_obj(const std::filesystem::path& file, const ImportLimits& limits);

}  // namespace billow::sim
