// A JSON schema against what the reader of its files knows.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cli/yaml/yaml_reader.h"

namespace billow::test {

/// Expects `object`, a map in a schema, to have the section's keys and no others, each with a description and with the
/// ranges and words that the reader accepts.
void expect_keys(const cli::Section& section, const nlohmann::json& object);

}  // namespace billow::test
