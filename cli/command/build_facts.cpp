// billow --version --json
#include "cli/command/build_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/text/json_text.h"
#include "cli/text/version.h"
#include "sim/pass/instruction_sets.h"

namespace billow::cli {

namespace {

using Json = nlohmann::ordered_json;

Json or_null(std::string_view text) { return text.empty() ? Json() : Json(text); }

Json libraries_as_json() {
  Json versions = Json::object();
  for (const auto& [library, found] : library_versions()) versions[library] = or_null(found);
  return versions;
}

}  // namespace

std::string compiler_text() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

// BILLOW_LIBRARIES, which the build defines, is "NAME=VERSION,NAME=VERSION".
std::vector<std::pair<std::string, std::string>> library_versions() {
  std::vector<std::pair<std::string, std::string>> versions;
  for (std::string_view rest = BILLOW_LIBRARIES; !rest.empty();) {
    const std::string_view entry = rest.substr(0, rest.find(','));
    const std::size_t equals = entry.find('=');
    versions.emplace_back(entry.substr(0, equals), entry.substr(equals + 1));
    rest.remove_prefix(std::min(entry.size() + 1, rest.size()));
  }
  return versions;
}

std::string build_facts_json(std::string_view commit) {
  constexpr std::string_view changed = "-dirty";  // commit.cmake
  const bool is_dirty = commit.ends_with(changed);
  const std::string_view hash = commit.substr(0, commit.size() - (is_dirty ? changed.size() : 0));
  const Json facts = {{"billow", version()},
                      {"commit", or_null(hash)},
                      {"dirty", hash.empty() ? Json() : Json(is_dirty)},
                      {"compiler", compiler_text()},
                      {"libraries", libraries_as_json()},
                      {"instruction_sets",
                       {{"compiled", sim::compiled_instruction_sets()}, {"chosen", sim::chosen_instruction_set()}}}};
  return json_text(facts, 1);
}

}  // namespace billow::cli
