// JSON schemas of scenes and studies, held against the keys that the readers know.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "cli/yaml/yaml_reader.h"

namespace billow::test {

/// scenes/NAME of the sources.
nlohmann::json schema(const std::string& name);

/// The alternative of `node` that is a map of keys, or `node` itself.
const nlohmann::json& as_object(const nlohmann::json& node);

/// The schema of a section by its path, such as "bodies[].cloth".
const nlohmann::json& section_of(const nlohmann::json& root, std::string path);

/// Expects `object` to have the section's keys, each with a description, the key's range and its words, and no others.
void expect_same_keys(const cli::Section& section, const nlohmann::json& object, const std::string& path);

}  // namespace billow::test
