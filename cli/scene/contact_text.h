// What of a scene touches what, in words.
#pragma once

#include <string>
#include <vector>

#include "cli/scene/scene.h"

namespace billow::cli {

/// A line for each body and each collider; none where nothing touches.
std::vector<std::string> contact_lines(const Scene& scene);

}  // namespace billow::cli
