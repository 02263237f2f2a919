// The page of a comparison in a real browser.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "render/image/exr.h"
#include "render/image/png.h"
#include "tests/support/browser.h"
#include "tests/support/golden.h"
#include "tests/support/mesh_files.h"
#include "tests/support/tool.h"

namespace billow {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

// A disc on a ground that grows lighter to the right.
render::Image picture(double x, double y, double radius, int width = 160, int height = 100) {
  render::Image image(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const bool inside = (u - x) * (u - x) + (v - y) * (v - y) < radius * radius;
      const std::uint8_t ground = static_cast<std::uint8_t>(90 + u / 2);
      for (int c = 0; c < 3; ++c) image.row(v)[3 * u + c] = inside ? static_cast<std::uint8_t>(60 + 70 * c) : ground;
    }
  return image;
}

class CompareReport : public testing::Test {
 protected:
  CompareReport() {
    write("a/<b> & far.png", picture(40, 50, 20));
    write("b/<b> & far.png", picture(100, 50, 20));
    write("a/near.png", picture(60, 50, 30));
    write("b/near.png", picture(61.5, 50, 30));
    write("a/same.png", picture(60, 50, 30));
    write("b/same.png", picture(60, 50, 30));
    write("a/size.png", picture(10, 10, 5, 20, 20));
    write("b/size.png", picture(10, 10, 5, 30, 20));
    write("b/new.png", picture(10, 10, 5, 20, 20));
    folder_.write("a/broken.png", "no image");
    write("b/broken.png", picture(10, 10, 5, 20, 20));
    const auto result = test::run_tool({"compare", "a", "b", "--report", "page"}, folder_.path());
    EXPECT_EQ(result.status, 3) << result.errors;
    const fs::path page = fs::path(BILLOW_SOURCE_DIR) / "tests/cli/command/compare_report_visit.html";
    fs::copy_file(page, folder_.path() / "page" / page.filename());
  }

  void write(const std::string& name, const render::Image& image) const {
    fs::create_directories((folder_.path() / name).parent_path());
    render::write_png(folder_.path() / name, image);
  }

  test::TemporaryFolder folder_;
};

TEST_F(CompareReport, ShowsAPairInEveryWay) {
  const test::Visit visit = test::visit(folder_.path() / "page", "compare_report_visit.html");
  EXPECT_THAT(visit.console, IsEmpty());
  const Json& seen = visit.result;
  ASSERT_TRUE(seen.contains("clicked")) << seen;
  EXPECT_EQ(seen["summary"], "1 of 6 the same, 4 different, 1 unreadable");
  EXPECT_EQ(seen["rows"], (Json{"broken.png", "new.png", "size.png", "<b> & far.png", "near.png", "same.png"}));

  EXPECT_EQ(seen["first"]["picture"], "broken.png");
  EXPECT_EQ(seen["first"]["why"], "UNREADABLE: a/broken.png: is not a PNG image");
  EXPECT_EQ(seen["first"]["impossible"], (Json{"swipe", "difference", "flip"}));
  EXPECT_EQ(seen["first"]["sizes"], (Json{{20, 20}}));

  const Json a = {91, 91, 91};  // the ground's at 3
  EXPECT_EQ(seen["side"]["picture"], "<b> & far.png");
  EXPECT_EQ(seen["side"]["sizes"], (Json{{160, 100}, {160, 100}}));
  EXPECT_EQ(seen["side"]["colours"], (Json{a, a}));
  EXPECT_THAT(seen["side"]["values"].get<std::string>(), HasSubstr("apart "));
  EXPECT_EQ(seen["swiped"], (Json{a, {255, 255, 255}, {96, 96, 96}}));
  EXPECT_EQ(seen["blinked"], (Json{a, a}));
  EXPECT_EQ(seen["difference"]["colours"], (Json{{0, 0, 0}}));
  EXPECT_EQ(seen["flip"]["sizes"], (Json{{160, 100}}));
  EXPECT_EQ(seen["pointed"], "(7, 2)   A 93 93 93   B 93 93 93   apart 0");
  EXPECT_EQ(seen["stepped"], "(7, 3)   A 93 93 93   B 93 93 93   apart 0");
  EXPECT_EQ(seen["worst"], seen["side"]["values"]);
  EXPECT_EQ(seen["clicked"], "broken.png");
}

TEST_F(CompareReport, LooksAsItShould) {
  fs::remove(folder_.path() / "a/broken.png");
  for (const char* name : {"a/size.png", "b/size.png", "b/new.png", "b/broken.png"}) fs::remove(folder_.path() / name);
  ASSERT_EQ(test::run_tool({"compare", "a", "b", "--report", "look"}, folder_.path()).status, 3);
  const test::Screenshot shot = test::screenshot(folder_.path() / "look", "index.html", 900, 1250);
  EXPECT_THAT(shot.console, IsEmpty());
  EXPECT_GOLDEN(shot.image, "compare_report");
}

// Frames of a colour of 0.25 and a velocity, whose X differs in one pixel of the last.
TEST(CompareReportOfNumbers, ShowsTheirLayersAndValues) {
  const test::TemporaryFolder folder;
  for (const char* side : {"a", "b"}) {
    fs::create_directories(folder.path() / side);
    for (int number = 1; number <= 3; ++number) {
      render::DataImage image{4, 3, {}};
      for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, std::vector<float>(12, 0.25f)});
      for (const char* name : {"velocity.X", "velocity.Y", "velocity.Z"})
        image.channels.push_back({name, std::vector<float>(12, 0.0f)});
      if (number == 3) image.channels[3].value[6] = side[0] == 'a' ? 1.5f : -2.0f;
      render::write_exr(folder.path() / side / ("f" + std::to_string(number) + ".exr"), image);
    }
  }
  ASSERT_EQ(test::run_tool({"compare", "a", "b", "--report", "page"}, folder.path()).status, 3);
  const fs::path page = fs::path(BILLOW_SOURCE_DIR) / "tests/cli/command/compare_values_visit.html";
  fs::copy_file(page, folder.path() / "page" / page.filename());
  const test::Visit visit = test::visit(folder.path() / "page", "compare_values_visit.html");
  EXPECT_THAT(visit.console, IsEmpty());
  const Json& seen = visit.result;
  ASSERT_TRUE(seen.contains("clicked")) << seen;
  EXPECT_EQ(seen["picture"], "f3.exr");
  EXPECT_EQ(seen["layers"], (Json{"colour (R, G, B)", "velocity (velocity.X, velocity.Y, velocity.Z)"}));
  EXPECT_EQ(seen["chosen"], 1);
  EXPECT_EQ(seen["values"],
            "(2, 1)\nvelocity.X   A 1.5   B -2   apart 3.5\nvelocity.Y   A 0   B 0   apart 0\n"
            "velocity.Z   A 0   B 0   apart 0");
  EXPECT_EQ(seen["caption"], "A: a/f3.exr, -2 to 2");
  EXPECT_EQ(seen["grey"], (Json{128, 128, 128}));
  EXPECT_EQ(seen["colour"], (Json{137, 137, 137}));    // of 0.25 in linear light
  EXPECT_EQ(seen["brighter"], (Json{188, 188, 188}));  // of 0.5
  EXPECT_EQ(seen["difference"], (Json{0, 0, 0}));
  EXPECT_EQ(seen["clicked"], "f1.exr");
}

}  // namespace
}  // namespace billow
