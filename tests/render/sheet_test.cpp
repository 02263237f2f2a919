// Sheets of pictures.
#include "render/sheet.h"

#include "sim/error.h"
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
  Sheet sheet{"Strips", "Two strips and three frames at their times.", {}, 0.0, 4.0, 400, {}};
  sheet.rows.push_back({"(a) first", {{ramp(80, 40), 400, 60, true, ""}}, {}, false});
  sheet.rows.push_back({"(b) ended at 3 s", {{ramp(60, 40), 300, 60, true, ""}}, {}, true});
  sheet.rows.push_back(
      {"(c) frames",
       {{ramp(9, 6), 90, 60, true, ""}, {ramp(9, 6), 90, 60, true, ""}, {ramp(9, 6), 90, 60, true, ""}},
       {0.0, 1.0, 3.0},
       false});
  EXPECT_GOLDEN(draw_sheet(sheet), "sheet_strips");
}

TEST(Sheet, HasColumnsAndCaptions) {
  Sheet sheet{"Spectra", "", {"explicit", "implicit"}, 0.0, 0.0, 0, {}};
  for (int row = 0; row < 2; ++row)
    sheet.rows.push_back(
        {"", {{ramp(5, 5), 100, 100, false, "1.0 s"}, {ramp(5, 5), 100, 100, false, "2.0 s"}}, {}, false});
  EXPECT_GOLDEN(draw_sheet(sheet), "sheet_columns");
}

// A panel shown at its own size is the image itself, and enlarged without smoothing each pixel is a square.
TEST(Sheet, KeepsPixels) {
  const Image image = ramp(7, 5);
  const Image page = draw_sheet({"", "", {}, 0.0, 0.0, 0, {{"", {{image, 21, 15, false, ""}}, {}, false}}});
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 21; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(page.row(28 + y)[3 * (28 + x) + c], image.row(y / 3)[3 * (x / 3) + c]) << x << ", " << y;
}

TEST(Sheet, RefusesToBeHuge) {
  const Sheet sheet{"", "", {}, 0.0, 0.0, 0, {{"", {{ramp(2, 2), 20000, 10, true, ""}}, {}, false}}};
  EXPECT_THROW(draw_sheet(sheet), InputError);
}

}  // namespace
}  // namespace billow::render
