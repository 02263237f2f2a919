// Counts that a mesh file claims, held against its size before anyone believes them.
#pragma once

#include <filesystem>

#include "sim/mesh/mesh_import.h"

namespace billow::sim {

/// Throws InputError when the header of a PLY or OFF file claims more elements than the file has bytes, or more
/// vertices or faces than `limits`: an importer that believed it would work for seconds before it found out.
void check_claims(const std::filesystem::path& file, const ImportLimits& limits);

}  // namespace billow::sim
