// The page of a comparison.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/command/compared_images.h"

namespace billow::cli {

/// Writes `folder`/index.html: all pairs, those that differ most first; the first forty with their pictures inside the
/// page, so that it can be sent as it is. Throws OutputError.
void write_compare_report(const std::filesystem::path& folder, std::vector<ComparedPair> pairs,
                          const CompareOptions& options);

}  // namespace billow::cli
