// Opening the files that a scene names.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "cli/scene/scene.h"

namespace billow::cli {

/// Throws InputError at `where` unless there is a regular file; `kind` is what messages call it. An empty path is none.
void check_file(const std::filesystem::path& file, std::string_view kind, const std::string& where);

/// Reads the texture, where there is one; `watch`, where there is one, hears of it before. Throws InputError.
void load_texture(Look& look, const FileWatch& watch);

/// Imports the mesh, which `watch` hears of before. Throws InputError at `where`.
sim::Mesh load_mesh(const std::filesystem::path& file, const std::string& where, const FileWatch& watch);

}  // namespace billow::cli
