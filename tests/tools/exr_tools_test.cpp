// Data frames as other programs read them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

using test::run_program;

class ExrTools : public testing::Test {
 protected:
  // One frame of two tiny pictures of the drape: the second is from a run of its own.
  void SetUp() override {
    for (const char* folder : {"a", "b"}) {
      const test::ToolResult result = test::run_tool(
          {"render", BILLOW_SOURCE_DIR "/scenes/drape.yaml", "-D", "duration=0.6", "-D", "render.size=[96, 54]", "-D",
           "render.views=[data, depth, normal, id]", "--frames", "15", "-o", folder},
          folder_.path());
      ASSERT_EQ(result.status, 0) << result.errors;
    }
  }
  std::string file(const char* folder) const { return (folder_.path() / folder / "data/frame_0015.exr").string(); }

  test::TemporaryFolder folder_;
};

TEST_F(ExrTools, ReadEveryChannelAndNoDate) {
  const test::ToolResult info = run_program("exrinfo", {"-v", file("a")}, folder_.path());
  // exrinfo 3.1.5 ends a good file with a status that it never set.
  ASSERT_EQ(info.errors, "");
  for (const char* channel :
       {"R",   "G",   "B",   "A",    "Z",    "velocity.X", "velocity.Y", "velocity.Z", "motion.X", "motion.Y",
        "N.X", "N.Y", "N.Z", "UV.U", "UV.V", "strain",     "id00.R",     "id00.A",     "id01.R",   "id01.A"})
    EXPECT_THAT(info.output, testing::HasSubstr(std::string("'") + channel + "': float")) << channel;
  EXPECT_THAT(info.output, testing::HasSubstr("MurmurHash3_32"));
  EXPECT_THAT(info.output, testing::Not(testing::HasSubstr("capDate")));
}

TEST_F(ExrTools, FindTwoRunsTheSameToTheByte) {
  EXPECT_EQ(test::read_text(file("a")), test::read_text(file("b")));
  const test::ToolResult diff = run_program("idiff", {file("a"), file("b")}, folder_.path());
  EXPECT_EQ(diff.status, 0) << diff.output << diff.errors;
}

TEST_F(ExrTools, SeeThePictureWhereTheAlphaIs) {
  const test::ToolResult stats = run_program("oiiotool", {"--stats", file("a")}, folder_.path());
  ASSERT_EQ(stats.status, 0) << stats.errors;
  // Red, green, blue, alpha …
  EXPECT_THAT(stats.output, testing::ContainsRegex("Stats Max: [^ ]+ [^ ]+ [^ ]+ 1\\.000000 "));
  EXPECT_THAT(stats.output, testing::ContainsRegex("Stats Min: [^ ]+ [^ ]+ [^ ]+ 0\\.000000 "));
}

TEST_F(ExrTools, ReadTheDepthViewAs16Bits) {
  const std::string depth = (folder_.path() / "a/depth/frame_0015.png").string();
  const test::ToolResult info = run_program("oiiotool", {"--info", "-v", depth}, folder_.path());
  ASSERT_EQ(info.status, 0) << info.errors;
  EXPECT_THAT(info.output, testing::HasSubstr("1 channel, uint16"));
  EXPECT_THAT(info.output, testing::HasSubstr("near"));
}

// What other programs write, in every packing that keeps values, reads as the same.
TEST(ForeignExr, ReadsTheSameHoweverItIsPacked) {
  const test::TemporaryFolder folder;
  const auto oiiotool = [&](std::vector<std::string> arguments) {
    const test::ToolResult result = run_program("oiiotool", arguments, folder.path());
    ASSERT_EQ(result.status, 0) << result.errors;
  };
  oiiotool({"--pattern", "noise:type=gaussian:mean=0.5:stddev=0.2", "70x50", "3", "-d", "half", "-o", "a.exr"});
  std::vector<std::string> files = {"float.exr", "tiled.exr"};
  oiiotool({"a.exr", "-d", "float", "-o", "float.exr"});
  oiiotool({"a.exr", "--tile", "16", "32", "-d", "half", "-o", "tiled.exr"});
  for (const std::string packing : {"none", "rle", "zip", "zips", "piz", "pxr24"}) {
    files.push_back(packing + ".exr");
    oiiotool({"a.exr", "--compression", packing, "-d", "half", "-o", files.back()});
  }
  for (const std::string& file : files)
    EXPECT_EQ(test::run_tool({"compare", "a.exr", file, "--channel", "0", "--worst", "0"}, folder.path()).status, 0)
        << file;
  oiiotool({"a.exr", "float.exr", "--siappend", "-o", "parts.exr"});
  EXPECT_THAT(test::run_tool({"compare", "a.exr", "parts.exr"}, folder.path()).output,
              testing::HasSubstr("only in parts.exr"));
}

TEST(ForeignExr, DiffersByWhatIdiffFinds) {
  const test::TemporaryFolder folder;
  run_program("oiiotool", {"--pattern", "noise:seed=1", "70x50", "4", "-d", "float", "-o", "a.exr"}, folder.path());
  run_program("oiiotool", {"--pattern", "noise:seed=2", "70x50", "4", "-d", "float", "-o", "b.exr"}, folder.path());
  const std::string seen = run_program("idiff", {"a.exr", "b.exr"}, folder.path()).output;
  const auto number = [&](const std::string& name) { return std::stod(seen.substr(seen.find(name) + name.size())); };
  const auto json =
      nlohmann::json::parse(test::run_tool({"compare", "a.exr", "b.exr", "--json"}, folder.path()).output)["images"][0];
  EXPECT_NEAR(json["mean"], number("Mean error = "), 1e-5);
  EXPECT_NEAR(json["rmse"], number("RMS error = "), 1e-5);
  EXPECT_NEAR(json["max"], number("Max error  = "), 1e-5);
}

}  // namespace
}  // namespace billow
