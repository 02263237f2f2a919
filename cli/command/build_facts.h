// What this build of the tool was made of. No result depends on it.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace billow::cli {

/// "gcc 12.2.0"
std::string compiler_text();

/// Names of the libraries and the versions that were found when the build was configured, empty where one has none.
std::vector<std::pair<std::string, std::string>> library_versions();

/// One JSON object: version, commit (null where `commit` is empty), whether what was built differs from it (`commit`
/// ends with "-dirty"; null where there is none), compiler, libraries as above, instruction sets of the vector passes.
std::string build_facts_json(std::string_view commit);

}  // namespace billow::cli
