// What this build of the tool was made of. No result depends on it.
#pragma once

#include <string>
#include <string_view>

namespace billow::cli {

/// One JSON object: version, commit (null where `commit` is empty), compiler, libraries with the versions that were
/// found when the build was configured, instruction sets of the vector passes.
std::string build_facts_json(std::string_view commit);

}  // namespace billow::cli
