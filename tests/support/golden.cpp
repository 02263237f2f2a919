// Comparing and accepting by what `billow compare` is made of.
#include "tests/support/golden.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "cli/command/compare_report.h"
#include "cli/command/compared_images.h"
#include "render/image/png.h"

namespace billow::test {
namespace {

namespace fs = std::filesystem;

bool updating() {
  const char* value = std::getenv("BILLOW_UPDATE_GOLDEN");
  return value && std::string_view(value) == "1";
}

testing::AssertionResult accepted(cli::ComparedPair pair, cli::CompareOptions options) {
  options.accept = true;
  try {
    std::vector<cli::ComparedPair> pairs{std::move(pair)};
    accept(pairs, options);
    return testing::AssertionSuccess();
  } catch (const InputError& error) {
    return testing::AssertionFailure() << error.what();
  }
}

testing::AssertionResult differing(const cli::ComparedPair& pair, const cli::CompareOptions& options) {
  const fs::path page = options.b / (pair.name + ".report");
  cli::write_compare_report(page, {pair}, options);
  return testing::AssertionFailure() << fmt::format(
             "{}: {}\nLook at {}\nIf it is right, run this test once with BILLOW_UPDATE_GOLDEN=1, or\n"
             "  billow compare {} {} --accept-only {}\nand commit {}",
             pair.name, pair.why, (page / "index.html").string(), options.a.string(), options.b.string(), pair.name,
             pair.a.string());
}

}  // namespace

fs::path golden_folder() { return fs::path(BILLOW_SOURCE_DIR) / "tests" / "golden"; }

testing::AssertionResult matches_golden(const render::Image& image, const std::string& name, const fs::path& folder) {
  cli::CompareOptions options;
  options.a = folder;
  options.b = fs::path(BILLOW_TEST_OUTPUT_DIR) / "golden";
  fs::create_directories(options.b);
  render::write_png(options.b / (name + ".png"), image);
  const cli::ComparedPair pair = cli::compared_picture(name + ".png", options);
  if (pair.verdict == cli::Verdict::same) return testing::AssertionSuccess();
  return updating() ? accepted(pair, options) : differing(pair, options);
}

}  // namespace billow::test
