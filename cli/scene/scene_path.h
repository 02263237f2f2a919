// The scene that another file names.
#pragma once

#include <filesystem>

#include "cli/yaml/yaml_reader.h"

namespace billow::cli {

/// The scene file under the key `scene`, relative to `folder`. Throws InputError where there is none, where it is no
/// scene and may not be quoted, or where it may not be read (base/file_trust.h).
std::filesystem::path read_scene_path(MapReader& map, const std::filesystem::path& folder);

}  // namespace billow::cli
