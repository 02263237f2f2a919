// Reading a scene with its progress shown.
#pragma once

#include "cli/run/progress.h"
#include "cli/scene/scene.h"

namespace billow::cli {

/// read_scene as the phase "reading", which says which mesh or texture takes long.
Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides, Progress& progress);

}  // namespace billow::cli
