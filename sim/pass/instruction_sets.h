// Which instruction sets the vector passes have, and which of them runs here.
#pragma once

#include <string>
#include <vector>

namespace billow::sim {

/// Those that the passes were compiled for, best first, by Highway's names.
std::vector<std::string> compiled_instruction_sets();

/// The one of these that this processor runs.
std::string chosen_instruction_set();

}  // namespace billow::sim
