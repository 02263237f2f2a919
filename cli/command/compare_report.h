// A comparison for those who look at it: a table, JSON, a page, and a file for servers that run tests.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cli/command/compared_images.h"

namespace billow::cli {

/// Writes `folder`/index.html: all pairs, those that differ most first; the first forty with their pictures inside the
/// page, so that it can be sent as it is. Throws OutputError.
void write_compare_report(const std::filesystem::path& folder, std::vector<ComparedPair> pairs,
                          const CompareOptions& options);

/// Writes the pairs as test cases of JUnit's XML, which build servers read: those that differ failed, those that cannot
/// be read are errors. `suite` is what made them. Throws OutputError.
void write_junit(const std::filesystem::path& file, const std::vector<ComparedPair>& pairs, const std::string& suite);

/// Prints a row for every pair.
void print_table(const std::vector<ComparedPair>& pairs, const CompareOptions& options);

/// The pairs with all that is known of them, and which were accepted.
nlohmann::ordered_json comparison_json(const std::vector<ComparedPair>& pairs,
                                       const std::vector<std::string>& accepted);

}  // namespace billow::cli
