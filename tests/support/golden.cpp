// Reading, judging and replacing baselines.
#include "tests/support/golden.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

#include "render/image/compare.h"
#include "render/image/png.h"

namespace billow::test {
namespace {

bool updating() {
  const char* value = std::getenv("BILLOW_UPDATE_GOLDEN");
  return value && std::string_view(value) == "1";
}

std::filesystem::path left_behind(const std::string& name, const char* kind) {
  const std::filesystem::path folder = BILLOW_TEST_OUTPUT_DIR;
  std::filesystem::create_directories(folder);
  return folder / fmt::format("{}.{}.png", name, kind);
}

std::string how_to_accept(const std::filesystem::path& baseline) {
  return fmt::format("\nIf it is right, run this test once with BILLOW_UPDATE_GOLDEN=1 and commit {}",
                     baseline.string());
}

testing::AssertionResult missing(const render::Image& image, const std::string& name,
                                 const std::filesystem::path& baseline) {
  const auto actual = left_behind(name, "actual");
  render::write_png(actual, image);
  return testing::AssertionFailure() << "there is no baseline " << baseline << "\nThe picture is " << actual
                                     << how_to_accept(baseline);
}

testing::AssertionResult differing(const render::Image& image, const render::Image& wanted, const std::string& name,
                                   const std::filesystem::path& baseline) {
  const auto actual = left_behind(name, "actual");
  render::write_png(actual, image);
  if (image.width != wanted.width || image.height != wanted.height)
    return testing::AssertionFailure() << "the picture " << actual << " and its baseline differ in size"
                                       << how_to_accept(baseline);
  const auto seen = left_behind(name, "difference");
  render::write_png_rows(seen, image.width, image.height, 3, [&](int y, std::uint8_t* row) {
    render::difference_row(image.row(y), image.channels, wanted.row(y), wanted.channels, image.width, row);
  });
  const render::Comparison c = render::compare(image, wanted);
  return testing::AssertionFailure() << fmt::format("differs from {}: by up to {}, {:.2f} % of the pixels by over 3\n",
                                                    baseline.string(), c.max, 100.0 * c.share_over)
                                     << "The picture is " << actual << "\nThe difference (times 8) is " << seen
                                     << how_to_accept(baseline);
}

}  // namespace

std::filesystem::path golden_folder() { return std::filesystem::path(BILLOW_SOURCE_DIR) / "tests" / "golden"; }

testing::AssertionResult matches_golden(const render::Image& image, const std::string& name,
                                        const std::filesystem::path& folder) {
  const std::filesystem::path baseline = folder / (name + ".png");
  if (updating()) {
    render::write_png(baseline, image);
    return testing::AssertionSuccess();
  }
  if (!std::filesystem::exists(baseline)) return missing(image, name, baseline);
  const render::Image wanted = render::read_png(baseline);
  const bool same_size = image.width == wanted.width && image.height == wanted.height;
  if (same_size && render::within_tolerance(render::compare(image, wanted))) return testing::AssertionSuccess();
  return differing(image, wanted, name, baseline);
}

}  // namespace billow::test
