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

std::string compiler_text() {
#if defined(__clang__)
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

Json or_null(std::string_view text) { return text.empty() ? Json() : Json(text); }

// BILLOW_LIBRARIES, which the build defines, is "NAME=VERSION,NAME=VERSION".
Json library_versions() {
  Json versions = Json::object();
  for (std::string_view rest = BILLOW_LIBRARIES; !rest.empty();) {
    const std::string_view entry = rest.substr(0, rest.find(','));
    const std::size_t equals = entry.find('=');
    versions[std::string(entry.substr(0, equals))] = or_null(entry.substr(equals + 1));
    rest.remove_prefix(std::min(entry.size() + 1, rest.size()));
  }
  return versions;
}

}  // namespace

std::string build_facts_json(std::string_view commit) {
  const Json facts = {{"billow", version()},
                      {"commit", or_null(commit)},
                      {"compiler", compiler_text()},
                      {"libraries", library_versions()},
                      {"instruction_sets",
                       {{"compiled", sim::compiled_instruction_sets()}, {"chosen", sim::chosen_instruction_set()}}}};
  return json_text(facts, 1);
}

}  // namespace billow::cli
