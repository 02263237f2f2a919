// set: of a study or a test, changes to the scene that it names.
#pragma once

#include <vector>

#include "cli/yaml/yaml_overrides.h"

namespace billow::cli {

/// {solver.method: rk4, …}: an override for every entry. Throws InputError.
std::vector<Override> read_changes(const Node& set);

}  // namespace billow::cli
