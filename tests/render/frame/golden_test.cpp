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

std::filesystem::path output(const std::string& name) {
  return std::filesystem::path(BILLOW_TEST_OUTPUT_DIR) / "golden" / name;
}

TEST(Golden, AcceptsWhatIsWithinTolerance) {
  const TemporaryFolder folder;
  render::write_png(folder.path() / "golden_accepts.png", grey(100));
  EXPECT_TRUE(matches_golden(grey(100), "golden_accepts", folder.path()));
  EXPECT_TRUE(matches_golden(grey(103), "golden_accepts", folder.path()));
}

TEST(Golden, TakesTheToleranceAndTheVersionsBesideTheBaseline) {
  const TemporaryFolder folder;
  render::write_png(folder.path() / "golden_wide.png", grey(100));
  folder.write("golden_wide.tolerance.yaml", "reason: it flickers\nchannel: 40\nworst: 40\n");
  EXPECT_TRUE(matches_golden(grey(140), "golden_wide", folder.path()));
  EXPECT_FALSE(matches_golden(grey(150), "golden_wide", folder.path()));
  render::write_png(folder.path() / "golden_wide.1.png", grey(200));
  EXPECT_TRUE(matches_golden(grey(200), "golden_wide", folder.path()));
}

TEST(Golden, FailsWithoutABaselineAndKeepsThePictureWhereItCanBeAccepted) {
  const TemporaryFolder folder;
  std::filesystem::remove(output("golden_missing.png"));
  const auto result = matches_golden(grey(100), "golden_missing", folder.path());
  EXPECT_FALSE(result);
  EXPECT_THAT(result.message(), testing::HasSubstr("golden_missing.png: missing in "));
  EXPECT_THAT(result.message(), testing::HasSubstr("BILLOW_UPDATE_GOLDEN=1"));
  EXPECT_THAT(result.message(), testing::HasSubstr("--accept-only golden_missing.png"));
  EXPECT_EQ(render::read_png(output("golden_missing.png")).pixels, grey(100).pixels);
}

TEST(Golden, ShowsBothOnAPageWhenTheyDiffer) {
  const TemporaryFolder folder;
  render::write_png(folder.path() / "golden_differing.png", grey(100));
  std::filesystem::remove_all(output("golden_differing.png.report"));
  const auto result = matches_golden(grey(120), "golden_differing", folder.path());
  EXPECT_FALSE(result);
  EXPECT_THAT(result.message(), testing::HasSubstr("200 px over 3/255 (100 %), worst 20 at (0, 0)"));
  EXPECT_TRUE(std::filesystem::exists(output("golden_differing.png.report/index.html")));
}

TEST(Golden, RefusesAnotherSize) {
  const TemporaryFolder folder;
  render::write_png(folder.path() / "golden_resized.png", render::Image(10, 20));
  EXPECT_FALSE(matches_golden(grey(0), "golden_resized", folder.path()));
}

TEST(Golden, ReplacesTheBaselineWhenAskedButNotOnAServer) {
  const TemporaryFolder folder;
  const char* const ci = getenv("CI");
  const std::string before = ci ? ci : "";
  setenv("BILLOW_UPDATE_GOLDEN", "1", 1);
  setenv("CI", "true", 1);
  EXPECT_FALSE(matches_golden(grey(7), "golden_updated", folder.path()));
  unsetenv("CI");
  EXPECT_TRUE(matches_golden(grey(7), "golden_updated", folder.path()));
  unsetenv("BILLOW_UPDATE_GOLDEN");
  if (!before.empty()) setenv("CI", before.c_str(), 1);
  EXPECT_EQ(render::read_png(folder.path() / "golden_updated.png").pixels, grey(7).pixels);
}

}  // namespace
}  // namespace billow::test
