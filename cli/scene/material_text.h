// What a scene's materials and densities came to, in words.
#pragma once

#include <string>
#include <vector>

#include "cli/scene/scene.h"

namespace billow::cli {

/// A line for each body that has a material or a density; `structure` is what the scene builds.
std::vector<std::string> material_lines(const Scene& scene, const sim::Structure& structure);

}  // namespace billow::cli
