// Pages in headless Chromium.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "render/image/image.h"

namespace billow::test {

/// What a page did when it was visited.
struct Visit {
  nlohmann::json result;             // what the visiting page left in its <pre id="result">; null when it left nothing
  std::vector<std::string> console;  // everything on the console: errors, failed requests, log lines
};

/// Opens FOLDER/`page`, which uses visit.js and defines `async function visit()`, from its file, lets `seconds` of the
/// page's own time go by, and reads what came of it. Pages may read frames within them, though they are files. Fails
/// the test when there is no chromium.
Visit visit(const std::filesystem::path& folder, const std::string& page, double seconds = 10.0);

/// The page as it looks in a window of this size, and what it wrote on the console meanwhile.
struct Screenshot {
  render::Image image;
  std::vector<std::string> console;
};
Screenshot screenshot(const std::filesystem::path& folder, const std::string& page, int width, int height);

}  // namespace billow::test
