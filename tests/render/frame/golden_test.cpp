// The golden test itself: what it accepts, what it refuses, and what it leaves behind.
#include "tests/support/golden.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/image/png.h"
#include "tests/support/mesh_files.h"

namespace billow::test {
namespace {

render::Image grey(int value) {
  render::Image image(20, 10);
  std::fill(image.pixels.begin(), image.pixels.end(), static_cast<std::uint8_t>(value));
  return image;
}

std::filesystem::path output(const std::string& name) { return std::filesystem::path(BILLOW_TEST_OUTPUT_DIR) / name; }

TEST(Golden, AcceptsWhatIsWithinTolerance) {
  const TemporaryFolder folder;
  render::write_png(folder.path() / "golden_accepts.png", grey(100));
  EXPECT_TRUE(matches_golden(grey(100), "golden_accepts", folder.path()));
  EXPECT_TRUE(matches_golden(grey(103), "golden_accepts", folder.path()));
}

TEST(Golden, FailsWithoutABaselineAndKeepsThePicture) {
  const TemporaryFolder folder;
  std::filesystem::remove(output("golden_missing.actual.png"));
  const auto result = matches_golden(grey(100), "golden_missing", folder.path());
  EXPECT_FALSE(result);
  EXPECT_THAT(result.message(), testing::HasSubstr("there is no baseline"));
  EXPECT_THAT(result.message(), testing::HasSubstr("BILLOW_UPDATE_GOLDEN=1"));
  EXPECT_EQ(render::read_png(output("golden_missing.actual.png")).pixels, grey(100).pixels);
}

TEST(Golden, KeepsThePictureAndTheDifferenceWhenTheyDiffer) {
  const TemporaryFolder folder;
  render::write_png(folder.path() / "golden_differing.png", grey(100));
  const auto result = matches_golden(grey(120), "golden_differing", folder.path());
  EXPECT_FALSE(result);
  EXPECT_THAT(result.message(), testing::HasSubstr("by up to 20, 100.00 % of the pixels"));
  EXPECT_EQ(render::read_png(output("golden_differing.difference.png")).pixels, grey(160).pixels);
}

TEST(Golden, RefusesAnotherSize) {
  const TemporaryFolder folder;
  render::write_png(folder.path() / "golden_resized.png", render::Image(10, 20));
  EXPECT_FALSE(matches_golden(grey(0), "golden_resized", folder.path()));
}

TEST(Golden, ReplacesTheBaselineWhenAsked) {
  const TemporaryFolder folder;
  setenv("BILLOW_UPDATE_GOLDEN", "1", 1);
  EXPECT_TRUE(matches_golden(grey(7), "golden_updated", folder.path()));
  unsetenv("BILLOW_UPDATE_GOLDEN");
  EXPECT_EQ(render::read_png(folder.path() / "golden_updated.png").pixels, grey(7).pixels);
}

}  // namespace
}  // namespace billow::test
