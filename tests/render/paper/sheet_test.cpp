// Sheets of pictures.
#include "render/paper/sheet.h"

#include "base/error.h"
#include "tests/support/golden.h"

namespace billow::render {
namespace {

Image ramp(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      image.row(y)[3 * x] = static_cast<std::uint8_t>(255 * x / std::max(1, width - 1));
      image.row(y)[3 * x + 1] = static_cast<std::uint8_t>(255 * y / std::max(1, height - 1));
    }
  return image;
}

TEST(Sheet, SharesOneTimeAxis) {
  Sheet sheet{"Strips", "Two strips and three frames at their times.", 0.0, 4.0, 400, {}};
  sheet.rows.push_back({"(a) first", {{ramp(80, 40), 400, 60, true, ""}}, {}, false});
  sheet.rows.push_back({"(b) ended at 3 s", {{ramp(60, 40), 300, 60, true, ""}}, {}, true});
  sheet.rows.push_back(
      {"(c) frames",
       {{ramp(9, 6), 90, 60, true, ""}, {ramp(9, 6), 90, 60, true, ""}, {ramp(9, 6), 90, 60, true, ""}},
       {0.0, 1.0, 3.0},
       false});
  sheet.scales = {velocity_scale(VelocityColour::components, 3.2)};
  EXPECT_GOLDEN(draw_sheet(sheet), "sheet_strips");
}

TEST(Sheet, HasHeadingsCaptionsAndScales) {
  Sheet sheet{"Spectra", "", 0.0, 0.0, 0, {}};
  for (int row = 0; row < 2; ++row)
    sheet.rows.push_back(
        {"",
         {{ramp(5, 5), 100, 100, false, "1.0 s"}, {ramp(5, 5), 100, 100, false, "a caption wider than its picture"}},
         {},
         false});
  sheet.rows[0].panels[0].heading = "explicit";
  sheet.rows[0].panels[1].heading = "implicit, of a longer name";
  sheet.scales = {velocity_scale(VelocityColour::magnitude, 0.5), power_scale(80)};
  EXPECT_GOLDEN(draw_sheet(sheet), "sheet_columns");
}

// A panel shown at its own size is the image itself, and enlarged without smoothing each pixel is a square.
TEST(Sheet, KeepsPixels) {
  const Image image = ramp(7, 5);
  const Image page = draw_sheet({"", "", 0.0, 0.0, 0, {{"", {{image, 21, 15, false, ""}}, {}, false}}});
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 21; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(page.row(28 + y)[3 * (28 + x) + c], image.row(y / 3)[3 * (x / 3) + c]) << x << ", " << y;
}

Sheet timed_sheet(const std::vector<double>& times) {
  Sheet sheet{"", "", 0.0, 4.0, 400, {}};
  sheet.rows.push_back({"", {}, times, false});
  for (std::size_t p = 0; p < times.size(); ++p) {
    Panel panel{Image(1, 1), 90, 20, false, ""};
    panel.image.pixels[0] = static_cast<std::uint8_t>(p + 1);
    sheet.rows[0].panels.push_back(panel);
  }
  return sheet;
}

// Left edges of the panels, from the margin: panel p is red p + 1 and else black.
std::vector<int> left_edges_of(const Image& page, std::size_t panels) {
  std::vector<int> left(panels, -1);
  for (int x = page.width - 1; x >= 0; --x) {
    const std::uint8_t* pixel = page.row(38) + 3 * x;
    if (pixel[1] == 0 && pixel[2] == 0 && pixel[0] >= 1 && pixel[0] <= panels) left[pixel[0] - 1] = x - 28;
  }
  return left;
}

TEST(Sheet, PutsPanelsAtTheirTimes) {
  EXPECT_EQ(left_edges_of(draw_sheet(timed_sheet({0.0, 1.0, 2.5})), 3), (std::vector<int>{0, 100, 250}));
}

// 90 wide and 6 apart: those that would cover each other, or run over the axis' end at 400, make room.
TEST(Sheet, KeepsCrowdedPanelsApart) {
  EXPECT_EQ(left_edges_of(draw_sheet(timed_sheet({0.0, 0.1, 2.0})), 3), (std::vector<int>{0, 96, 200}));
  EXPECT_EQ(left_edges_of(draw_sheet(timed_sheet({1.0, 3.5, 3.9})), 3), (std::vector<int>{100, 214, 310}));
  EXPECT_EQ(left_edges_of(draw_sheet(timed_sheet({3.9, 1.0, 3.5})), 3), (std::vector<int>{310, 100, 214}));
  const Image crowded = draw_sheet(timed_sheet({0, 0, 0, 0, 4}));
  EXPECT_EQ(left_edges_of(crowded, 5), (std::vector<int>{0, 96, 192, 288, 384}));
  EXPECT_EQ(crowded.width, 28 + 384 + 90 + 28);
}

// Nothing but the lines is between the axis and the pictures that they lead to: the label stands below these.
TEST(Sheet, LeavesTheLinesToItsPicturesFree) {
  const auto page_with = [](const std::string& label) {
    Sheet sheet{"", "", 0.0, 4.0, 400, {}};
    sheet.rows.push_back({"", {{ramp(8, 4), 400, 40, true, ""}}, {}, true});
    sheet.rows.push_back({label, {{ramp(9, 6), 90, 60, true, ""}}, {0.4}, false});
    return draw_sheet(sheet);
  };
  const Image plain = page_with(""), labelled = page_with("frames of a run that has a name");
  EXPECT_GT(labelled.height, plain.height);
  const int end_of_pictures = 28 + 40 + 44 + 12 + 18 + 60;
  for (int y = 0; y < end_of_pictures; ++y)
    ASSERT_TRUE(std::equal(plain.row(y), plain.row(y) + 3 * plain.width, labelled.row(y))) << y;
}

TEST(Sheet, BreaksLongLabels) {
  const auto page_with = [](const std::string& label) {
    Sheet sheet{"", "", 0.0, 0.0, 0, {}};
    sheet.rows.push_back({label, {{ramp(5, 5), 100, 100, true, ""}}, {}, false});
    return draw_sheet(sheet);
  };
  const Image one = page_with("short"), two = page_with("a label that is wider"),
              word = page_with(std::string(40, 'x'));
  EXPECT_EQ(two.width, one.width);
  EXPECT_GT(two.height, one.height);
  EXPECT_EQ(word.width, one.width);
  EXPECT_GT(word.height, two.height);
}

TEST(Sheet, SaysWhatItsColoursStandFor) {
  const SheetScale scale = velocity_scale(VelocityColour::components, 3.19412);
  EXPECT_EQ(scale.title, "velocity along each axis [m/s]");
  EXPECT_EQ(scale.low + scale.middle + scale.high, "−3.190+3.19");
  ASSERT_EQ(scale.bars.size(), 3u);
  EXPECT_EQ(scale.bars[1].colours.back(), velocity_rgb({0.0, 1.0, 0.0}, 1.0));
  EXPECT_EQ(velocity_scale(VelocityColour::magnitude, 4).bars[0].colours.back(), magnitude_rgb(1.0));
  EXPECT_EQ(power_scale(80).low + power_scale(80).high, "−800");
}

// Cairo refuses bytes that are no UTF-8, and Unicode's noncharacters.
TEST(Sheet, ShowsAnyText) {
  const auto with_title = [](const std::string& text) {
    Sheet sheet{text, text, 0.0, 0.0, 0, {}};
    sheet.rows.push_back({text, {{ramp(5, 5), 50, 50, true, text}}, {}, false});
    return draw_sheet(sheet).pixels;
  };
  for (const char* text : {"\uFFFE", "\uFDD0", "\xff", "\x01"}) EXPECT_EQ(with_title(text), with_title("\uFFFD"));
  EXPECT_EQ(with_title("a\nb"), with_title("a b"));
  EXPECT_NE(with_title("a b"), with_title("ab"));
}

TEST(Sheet, RefusesWhatCannotBeShown) {
  Sheet sheet = timed_sheet({0.0, 1.0});
  sheet.end = sheet.begin;
  EXPECT_THROW(draw_sheet(sheet), InputError);
  sheet = timed_sheet({0.0, 1.0});
  sheet.rows[0].times.pop_back();
  EXPECT_THROW(draw_sheet(sheet), InputError);
  sheet = timed_sheet({0.0});
  sheet.rows[0].panels[0].image = Image();
  EXPECT_THROW(draw_sheet(sheet), InputError);
  sheet = timed_sheet({0.0});
  sheet.rows[0].panels[0].height = 0;
  EXPECT_THROW(draw_sheet(sheet), InputError);
}

TEST(Sheet, RefusesToBeHuge) {
  const Sheet sheet{"", "", 0.0, 0.0, 0, {{"", {{ramp(2, 2), 20000, 10, true, ""}}, {}, false}}};
  EXPECT_THROW(draw_sheet(sheet), InputError);
}

}  // namespace
}  // namespace billow::render
