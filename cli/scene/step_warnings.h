// What a user should know of a step before it is taken.
#pragma once

#include <string>
#include <vector>

#include "cli/scene/simulation.h"

namespace billow::cli {

/// Sentences without an end mark, for check, render and stability.
std::vector<std::string> step_warnings(const sim::Structure& structure, const StepChoice& choice);

}  // namespace billow::cli
