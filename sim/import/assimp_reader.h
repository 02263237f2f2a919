// A mesh file -> polygons, through assimp. Runs in the importing child process only.
#pragma once

#include <filesystem>

#include "sim/import/mesh_import.h"
#include "sim/mesh/mesh.h"

namespace billow::sim {

/// The polygons of `file`, an existing mesh with one of the supported extensions. Only the importer of that extension
/// is tried, and it may open only files of the mesh's own folder and below. Node transforms are applied, quads kept,
/// larger polygons cut into a fan from their first corner, points and lines skipped. Throws InputError when assimp
/// refuses the file or the mesh exceeds `limits`.
PolygonSoup read_with_assimp(const std::filesystem::path& file, const ImportLimits& limits);

}  // namespace billow::sim
