// A filter in words.
#pragma once

#include <string>

#include "cli/scene/simulation.h"

namespace billow::cli {

/// What the scene filters with, on one line: "levels ×6.7, of force". "none", also where levels need not be taken.
std::string filter_text(const Scene& scene, const Simulation& simulation);

/// "level 1: 625 nodes, γ = 0.151" and so on for every body and level that takes part, a line each; none for a filter
/// without levels.
std::vector<std::string> level_lines(const Simulation& simulation);

}  // namespace billow::cli
