// Command lines for chromium, and what it prints.
#include "tests/support/browser.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <sstream>
#include <utility>

#include "render/image/png.h"
#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow::test {
namespace {

namespace fs = std::filesystem;

// A fresh profile, nothing from the network, WebGL in software, and no part of the machine that a container may lack.
ToolResult run_chromium(const fs::path& folder, const std::string& page, const std::vector<std::string>& task) {
  const TemporaryFolder home;
  std::vector<std::string> arguments{"--signal=KILL", "60", "chromium"};
  for (const char* option :
       {"--headless", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-quic",
        "--disable-dev-shm-usage", "--no-first-run", "--disable-background-networking", "--disable-component-update",
        "--disable-sync", "--hide-scrollbars", "--force-device-scale-factor=1", "--force-color-profile=srgb",
        "--enable-logging=stderr", "--allow-file-access-from-files"})
    arguments.emplace_back(option);
  arguments.push_back("--user-data-dir=" + home.path().string());
  arguments.insert(arguments.end(), task.begin(), task.end());
  arguments.push_back("file://" + fs::absolute(folder / page).string());
  const ToolResult result = run_program("timeout", arguments, home.path());
  if (result.status == 127)
    ADD_FAILURE() << "there is no chromium to test pages with; ./billow test installs it, or: apt-get install chromium";
  else
    EXPECT_EQ(result.status, 0) << result.errors;
  return result;
}

// Chromium logs a console message as "[...:CONSOLE(12)] "text", source: ...".
std::vector<std::string> console_of(const std::string& log) {
  std::vector<std::string> console;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);)
    if (line.find("CONSOLE") != std::string::npos) console.push_back(line);
  return console;
}

// The page is printed as HTML.
std::string unescaped(std::string text) {
  for (const auto& [written, meant] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
    for (std::size_t at = 0; (at = text.find(written, at)) != std::string::npos; at += 1)
      text.replace(at, std::strlen(written), meant);
  return text;
}

nlohmann::json result_in(const std::string& page) {
  const std::string open = "<pre id=\"result\">";
  const std::size_t begin = page.find(open);
  const std::size_t end = page.find("</pre>", begin);
  if (begin == std::string::npos || end == std::string::npos) return {};
  return nlohmann::json::parse(unescaped(page.substr(begin + open.size(), end - begin - open.size())), nullptr, false);
}

}  // namespace

Visit visit(const fs::path& folder, const std::string& page, double seconds) {
  fs::copy_file(fs::path(BILLOW_SOURCE_DIR) / "tests/support/visit.js", folder / "visit.js",
                fs::copy_options::overwrite_existing);
  const ToolResult result =
      run_chromium(folder, page, {"--dump-dom", fmt::format("--virtual-time-budget={:.0f}", 1000.0 * seconds)});
  return {result_in(result.output), console_of(result.errors)};
}

Screenshot screenshot(const fs::path& folder, const std::string& page, int width, int height) {
  const TemporaryFolder pictures;
  const fs::path file = pictures.path() / "page.png";
  const ToolResult result =
      run_chromium(folder, page,
                   {"--screenshot=" + file.string(), fmt::format("--window-size={},{}", width, height),
                    "--virtual-time-budget=3000"});
  if (!fs::exists(file)) return {{}, console_of(result.errors)};
  return {render::read_png(file), console_of(result.errors)};
}

}  // namespace billow::test
