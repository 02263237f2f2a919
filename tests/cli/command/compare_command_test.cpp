// billow compare from outside: what it says of each pair, and how it ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/comparing.h"

namespace billow {
namespace {

using render::Image;
using test::ToolResult;
using testing::HasSubstr;
using Json = nlohmann::json;

class CompareCommand : public test::Comparing {};

TEST_F(CompareCommand, JudgesEveryPairOfTwoFolders) {
  write("a/1 size.png", picture(3, 3));
  write("b/1 size.png", picture(2, 3));
  write("a/2 content.png", picture());
  write("b/2 content.png", changed(picture(), 3, 4, 90));
  write("a/3 damaged.png", picture());
  folder_.write("b/3 damaged.png", "\x89PNG\r\n");
  write("a/4 same.PNG", picture());
  write("b/4 same.PNG", picture());
  write("a/below/5 gone.png", picture());
  write("b/6 new.png", picture());
  folder_.write("b/no image.txt", "");
  const ToolResult result = compare({"a", "b"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.output, HasSubstr("DIFFERENT: 3 x 3 and 2 x 3 pixels\n"));
  EXPECT_THAT(result.output,
              HasSubstr("DIFFERENT: 1 px over 3/255 (0.5 %), worst 90 at (3, 4), none at an edge; allowed: worst 16"));
  EXPECT_THAT(result.output, HasSubstr("UNREADABLE: b/3 damaged.png: "));
  EXPECT_THAT(result.output, HasSubstr("  same\n"));
  EXPECT_THAT(result.output, HasSubstr("DIFFERENT: missing in a\n"));
  EXPECT_THAT(result.output, HasSubstr("DIFFERENT: missing in b\n1 of 6 the same\n"));

  const Json json = Json::parse(compare({"a", "b", "--json"}).output);
  EXPECT_EQ(json["same"], false);
  ASSERT_EQ(json["images"].size(), 6u);
  EXPECT_EQ(json["images"][1]["name"], "2 content.png");
  EXPECT_EQ(json["images"][1]["a"], "a/2 content.png");
  EXPECT_EQ(json["images"][1]["worst"], (Json{3, 4}));
  EXPECT_EQ(json["images"][2]["readable"], false);
  EXPECT_EQ(json["images"][3]["same"], true);
}

TEST_F(CompareCommand, EndsWith4OnlyWhereNothingCouldBeCompared) {
  write("a/1.png", picture());
  folder_.write("b/1.png", "no image");
  const ToolResult result = compare({"a", "b"});
  EXPECT_EQ(result.status, 4);
  EXPECT_THAT(result.output, HasSubstr("UNREADABLE: b/1.png: is not a PNG image"));
  EXPECT_EQ(result.errors, "b/1.png: is not a PNG image\n");
  EXPECT_EQ(compare({"a/1.png", "b/1.png"}).errors, "b/1.png: is not a PNG image\n");
  write("a/2.png", picture());
  EXPECT_EQ(compare({"a", "b"}).status, 3);
}

TEST_F(CompareCommand, SaysWhereTheDifferenceIs) {
  EXPECT_EQ(why(picture(), picture()), "equal");
  EXPECT_EQ(why(picture(), changed(picture(), 7, 2, 2)), "no pixel over 3/255, worst 2 at (7, 2)");
  EXPECT_EQ(why(picture(), changed(picture(), 3, 5, 10)),
            "1 px over 3/255 (0.5 %), worst 10 at (3, 5), none at an edge");
  EXPECT_EQ(why(picture(), changed(changed(picture(), 9, 0, 10), 10, 9, 12)),
            "2 px over 3/255 (1 %), worst 12 at (10, 9), all within 1 px of an edge");
  EXPECT_EQ(why(picture(), changed(changed(picture(), 8, 0, 10), 10, 9, 12)),
            "2 px over 3/255 (1 %), worst 12 at (10, 9), 1 off any edge");
}

TEST_F(CompareCommand, TakesOtherTolerances) {
  write("a.png", picture());
  write("b.png", changed(changed(picture(), 3, 5, 30), 4, 6, 20));
  const auto status = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"a.png", "b.png"});
    return compare(more).status;
  };
  EXPECT_EQ(status({}), 3);                 // 30 is over 16
  EXPECT_EQ(status({"--worst", "30"}), 0);  // 2 of 200 pixels are 1 %
  EXPECT_EQ(status({"--worst", "29"}), 3);
  EXPECT_EQ(status({"--worst", "30", "--pixels", "0.9%"}), 3);
  EXPECT_EQ(status({"--worst", "30", "--pixels", "2"}), 0);
  EXPECT_EQ(status({"--worst", "30", "--pixels", "1"}), 3);
  EXPECT_EQ(status({"--worst", "30", "--pixels", "1", "--channel", "20"}), 0);
  EXPECT_EQ(status({"--worst", "30", "--pixels", "0", "--channel", "30"}), 0);
  for (const char* wrong : {"-1", "1.5", "101%", "nan", "x", "%", "1%%", "2 %"})
    EXPECT_EQ(status({std::string("--pixels=") + wrong}), 2) << wrong;
  EXPECT_EQ(status({"--worst", "256"}), 2);
  EXPECT_EQ(status({"--channel", "-1"}), 2);
}

TEST_F(CompareCommand, JudgesByTheMetricsThatItIsGiven) {
  write("a.png", picture());
  write("b.png", changed(picture(), 3, 5, 30));
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"a.png", "b.png", "--json"});
    return compare(more);
  };
  const Json found = Json::parse(with({"--metric", "flip=1"}).output)["images"][0];
  const double rmse = found["rmse"], psnr = found["psnr"], ssim = found["ssim"], flip = found["flip"];
  EXPECT_GT(flip, 0.0);
  EXPECT_LT(flip, 0.1);
  const auto status = [&](const std::string& metric, double limit) {
    return with({"--metric", metric + "=" + std::to_string(limit)}).status;
  };
  EXPECT_EQ(status("max", 30), 0);
  EXPECT_EQ(status("max", 29), 3);
  EXPECT_EQ(status("rmse", rmse + 0.001), 0);
  EXPECT_EQ(status("rmse", rmse - 0.001), 3);
  EXPECT_EQ(status("psnr", psnr - 0.001), 0);
  EXPECT_EQ(status("psnr", psnr + 0.001), 3);
  EXPECT_EQ(status("ssim", ssim - 0.001), 0);
  EXPECT_EQ(status("ssim", ssim + 0.001), 3);
  EXPECT_EQ(status("flip", flip + 0.00001), 0);
  EXPECT_EQ(status("flip", flip - 0.00001), 3);
  const ToolResult broken = with({"--metric", "max=30", "--metric", "rmse=0.1"});
  EXPECT_EQ(broken.status, 3);
  EXPECT_THAT(broken.output, HasSubstr(" and not at most 0.1: "));
  EXPECT_THAT(broken.output, testing::Not(HasSubstr("max 3")));
  for (const char* wrong : {"flap=1", "flip", "flip=", "flip=x", "flip=-1", "=1", "flip=1x"})
    EXPECT_EQ(with({"--metric", wrong}).status, 2) << wrong;
  EXPECT_EQ(with({"--metric", "max=1", "--worst", "3"}).status, 2);
}

TEST_F(CompareCommand, CountsWhatTheMaskLeaves) {
  write("a.png", picture());
  write("b.png", changed(picture(), 3, 5, 100));
  Image mask(20, 10);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 20; ++x)
      for (int c = 0; c < 3; ++c) mask.row(y)[3 * x + c] = x == 3 ? 127 : 128;
  write("mask.png", mask);
  EXPECT_EQ(compare({"a.png", "b.png", "--mask", "mask.png"}).status, 0);
  const Json json = Json::parse(compare({"a.png", "b.png", "--mask", "mask.png", "--json"}).output);
  EXPECT_EQ(json["images"][0]["pixels"], 190);
  EXPECT_EQ(json["images"][0]["max"], 0);

  write("black.png", Image(20, 10));
  EXPECT_EQ(compare({"a.png", "b.png", "--mask", "black.png"}).errors,
            "no pixel counts: the mask is black everywhere; make white what counts\n");
  write("small.png", picture(4, 4));
  const ToolResult small = compare({"a.png", "b.png", "--mask", "small.png"});
  EXPECT_EQ(small.status, 4);
  EXPECT_EQ(small.errors, "small.png: the mask has 4 x 4 pixels and the image 20 x 10\n");
  EXPECT_EQ(
      compare({"a.png", "b.png", "--mask", "none.png"}).errors,
      "the mask none.png: cannot open the image: No such file or directory; give a PNG image of the pictures' size, "
      "white where it counts\n");
}

TEST_F(CompareCommand, CanIgnoreAlpha) {
  write("a.png", picture(20, 10, 3));
  write("b.png", picture(20, 10, 4));
  EXPECT_EQ(compare({"a.png", "b.png"}).status, 3);
  EXPECT_EQ(compare({"a.png", "b.png", "--ignore-alpha"}).status, 0);
}

TEST_F(CompareCommand, TakesTheToleranceBesideABaseline) {
  write("a/1.png", picture());
  write("b/1.png", changed(picture(), 3, 5, 60));
  write("a/2.png", picture());
  write("b/2.png", changed(picture(), 3, 5, 60));
  folder_.write("a/1.tolerance.yaml", "reason: a lamp flickers\nworst: 60\npixels: 1\n");
  const ToolResult result = compare({"a", "b"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.output, HasSubstr("same (by its own tolerance: a lamp flickers)\n"));
  EXPECT_THAT(result.output, HasSubstr("1 of 2 the same\n"));
  folder_.write("a/2.tolerance.yaml", "reason: r\nmetrics: {ssim: 0.5, flip: 0.2}\n");
  EXPECT_EQ(compare({"a", "b"}).status, 0);
  EXPECT_EQ(compare({"a/1.png", "b/1.png"}).status, 0);
}

TEST_F(CompareCommand, SaysWhatIsWrongWithATolerance) {
  write("a/1.png", picture());
  write("b/1.png", picture());
  write("a/2.png", picture());
  write("b/2.png", picture());
  const auto fault = [&](const std::string& text) {
    folder_.write("a/1.tolerance.yaml", text);
    const Json json = Json::parse(compare({"a", "b", "--json"}).output);
    EXPECT_EQ(json["images"][1]["same"], true);  // the other is judged all the same
    EXPECT_EQ(json["images"][0]["readable"], false);
    const std::string why = json["images"][0]["why"];
    return why.substr(why.find("1.tol"));
  };
  EXPECT_EQ(fault("worst: 20\n"),
            "1.tolerance.yaml:1:1: the tolerance needs the key 'reason'; say why this picture needs another tolerance");
  EXPECT_EQ(fault("reason: ' '\n"),
            "1.tolerance.yaml:1:9: the reason is empty; say why this picture needs another tolerance");
  EXPECT_EQ(fault("reason: r\npixels: many\n"),
            "1.tolerance.yaml:2:9: pixels is 'many', and should be a number like 250 or a share like 0.5%");
  EXPECT_THAT(fault("reason: r\nworst: 256\n"), HasSubstr("1.tolerance.yaml:2:8: "));
  EXPECT_THAT(fault("reason: r\nmetrics: {flap: 1}\n"), HasSubstr("did you mean 'flip'?"));
}

TEST_F(CompareCommand, TakesAnyVersionOfABaseline) {
  write("a/1.png", picture());
  write("a/1.1.png", changed(picture(), 3, 5, 60));
  write("a/1.2.png", changed(picture(), 4, 5, 60));
  write("b/1.png", changed(picture(), 4, 5, 60));
  const Json json = Json::parse(compare({"a", "b", "--json"}).output);
  ASSERT_EQ(json["images"].size(), 1u);
  EXPECT_EQ(json["images"][0]["a"], "a/1.2.png");
  EXPECT_EQ(json["images"][0]["why"], "equal, to 1.2.png");
  EXPECT_EQ(json["same"], true);
  write("b/1.png", changed(picture(), 5, 5, 60));
  EXPECT_EQ(Json::parse(compare({"a", "b", "--json"}).output)["images"][0]["a"], "a/1.png");
  write("b/1.1.png", picture());  // now both folders have it: a picture of its own
  EXPECT_EQ(Json::parse(compare({"a", "b", "--json"}).output)["images"].size(), 3u);  // and 1.2.png is missing in b
}

TEST_F(CompareCommand, WritesWhatBuildServersRead) {
  write("a/1 & 2.png", picture());
  write("b/1 & 2.png", picture());
  write("a/3.png", picture());
  folder_.write("b/3.png", "no image");
  write("b/4.png", picture());
  EXPECT_EQ(compare({"a", "b", "--junit", "tests.xml"}).status, 3);
  EXPECT_EQ(test::read_text(folder_.path() / "tests.xml"),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<testsuite name=\"billow compare a b\" tests=\"3\" failures=\"1\" errors=\"1\">\n"
            "  <testcase classname=\"billow compare a b\" name=\"1 &amp; 2.png\"/>\n"
            "  <testcase classname=\"billow compare a b\" name=\"3.png\">\n"
            "    <error message=\"b/3.png: is not a PNG image\"/>\n"
            "  </testcase>\n"
            "  <testcase classname=\"billow compare a b\" name=\"4.png\">\n"
            "    <failure message=\"missing in a\"/>\n"
            "  </testcase>\n"
            "</testsuite>\n");
}

TEST_F(CompareCommand, SaysWhatItDoesNotLookInto) {
  write("a/1.png", picture());
  write("b/1.png", picture());
  std::filesystem::create_directory_symlink("..", folder_.path() / "a/up");
  std::filesystem::create_symlink("nowhere", folder_.path() / "b/2.png");
  folder_.write("a/One.tolerance.yaml", "reason: a slip\n");
  const ToolResult result = compare({"a", "b"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.output, HasSubstr("UNREADABLE: a/up: is a link to a folder, which is not followed\n"));
  EXPECT_THAT(result.output, HasSubstr("UNREADABLE: b/2.png: cannot open the image: No such file or directory\n"));
  EXPECT_THAT(result.output, HasSubstr("UNREADABLE: there is no picture One.png or One.exr that it is for\n"));
  EXPECT_THAT(result.output, HasSubstr("1 of 4 the same\n"));
}

TEST_F(CompareCommand, TakesAMaskBesideABaselineForNoPicture) {
  write("a/1.png", picture());
  write("b/1.png", changed(picture(), 3, 5, 100));
  Image mask(20, 10);
  for (auto& value : mask.pixels) value = 255;
  for (int c = 0; c < 3; ++c) mask.row(5)[3 * 3 + c] = 0;
  write("a/1_mask.png", mask);
  folder_.write("a/1.tolerance.yaml", "reason: r\nmask: 1_mask.png\n");
  const ToolResult result = compare({"a", "b"});
  EXPECT_EQ(result.status, 0) << result.output;
}

TEST_F(CompareCommand, AllowsEdgesThatAreAsideWhereAskedTo) {
  Image moved = picture();
  for (int y = 0; y < 10; ++y)
    for (int c = 0; c < 3; ++c) moved.row(y)[3 * 10 + c] = 120;
  write("a/1.png", picture());
  write("b/1.png", moved);
  EXPECT_EQ(compare({"a", "b"}).status, 3);
  const ToolResult allowed = compare({"a", "b", "--edge", "1"});
  EXPECT_EQ(allowed.status, 0);
  EXPECT_THAT(allowed.output, HasSubstr("same: equal, 10 px explained by edges nearby"));
  EXPECT_EQ(compare({"a", "b", "--edge", "5"}).status, 2);
  folder_.write("a/1.tolerance.yaml", "reason: another rasteriser\nedge: 1\nchannel: 0.5%\nworst: 0\n");
  EXPECT_EQ(compare({"a", "b"}).status, 0);
  folder_.write("a/1.tolerance.yaml", "reason: r\nedge: 5\n");
  EXPECT_THAT(compare({"a", "b"}).output, HasSubstr("1.tolerance.yaml:2:7: "));
}

TEST_F(CompareCommand, SaysWhereASequenceBeginsToDiffer) {
  for (int k = 8; k <= 12; ++k) {
    const std::string name = (k < 10 ? "film/frame_0" : "film/frame_") + std::to_string(k) + ".png";
    write("a/" + name, picture());
    write("b/" + name, changed(picture(), 3, 5, k < 9 ? 0 : k < 10 ? 1 : k == 11 ? 90 : 60));
  }
  write("a/other.png", picture());
  write("b/other.png", picture());
  const std::string table = compare({"a", "b"}).output;
  EXPECT_THAT(table,
              HasSubstr("film/frame_##.png: 5 frames, 3 differ, the first 10, unequal from 9 on; the worst 11: "));
  const Json json = Json::parse(compare({"a", "b", "--json"}).output)["sequences"];
  ASSERT_EQ(json.size(), 1u);
  EXPECT_EQ(json[0]["frames"], (Json{8, 9, 10, 11, 12}));
  EXPECT_EQ(json[0]["max"], (Json{0, 1, 60, 90, 60}));
  EXPECT_EQ(json[0]["same"], (Json{true, true, false, false, false}));
  EXPECT_EQ(json[0]["first_different"], 10);
  EXPECT_EQ(json[0]["first_unequal"], 9);
  EXPECT_EQ(json[0]["worst"], 11);
}

TEST_F(CompareCommand, WritesTheDifferencesOfFolders) {
  write("a/1.png", picture());
  write("b/1.png", picture());
  write("a/below/2.png", picture());
  write("b/below/2.png", changed(picture(), 3, 5, 100));
  EXPECT_EQ(compare({"a", "b", "--diff", "d"}).status, 3);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "d/1.png"));
  EXPECT_EQ(render::read_png(folder_.path() / "d/below/2.png").row(5)[3 * 3], 255);
  const ToolResult among = compare({"a", "b", "--diff", "b/d"});
  EXPECT_EQ(among.status, 4);
  EXPECT_THAT(among.errors, HasSubstr("--diff: b/d lies in b, whose images are compared; name another folder"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "b/d"));
}

TEST_F(CompareCommand, ReplacesNeitherAnImageNorAnotherPage) {
  write("a.png", picture());
  write("b.png", changed(picture(), 3, 5, 100));
  EXPECT_EQ(compare({"a.png", "b.png", "--diff", "./a.png"}).errors,
            "--diff would replace one of the images; name another file\n");
  folder_.write("site/index.html", "<html>mine</html>");
  EXPECT_EQ(compare({"a.png", "b.png", "--report", "site"}).status, 6);
  EXPECT_EQ(test::read_text(folder_.path() / "site/index.html"), "<html>mine</html>");
  EXPECT_EQ(compare({"a.png", "b.png", "--report", "page"}).status, 3);
  EXPECT_EQ(compare({"a.png", "b.png", "--report", "page"}).status, 3);
}

}  // namespace
}  // namespace billow
