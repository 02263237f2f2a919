// Pictures without a background: composited over one, they are the pictures with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/srgb.h"
#include "tests/support/drawn_sheet.h"

namespace billow::render {
namespace {

using test::draw_sheet;
using test::DrawnSheet;
using test::sheet_settings;
using test::wavy_sheet;

Settings transparent(Settings settings) {
  settings.background.none = true;
  return settings;
}

// `over`, straight alpha, before `under`, in linear light.
Image composited(const Image& over, const Image& under) {
  Image result(under.width, under.height, 3);
  for (int y = 0; y < under.height; ++y)
    for (int x = 0; x < under.width; ++x) {
      const std::uint8_t* front = over.row(y) + 4 * x;
      for (int c = 0; c < 3; ++c) {
        const double a = front[3] / 255.0;
        const double light =
            a * srgb_to_linear(front[c] / 255.0) + (1.0 - a) * srgb_to_linear(under.row(y)[3 * x + c] / 255.0);
        result.row(y)[3 * x + c] = static_cast<std::uint8_t>(std::lround(255.0 * linear_to_srgb(light)));
      }
    }
  return result;
}

int largest_difference(const Image& a, const Image& b) {
  int most = 0;
  for (std::size_t k = 0; k < a.pixels.size(); ++k) most = std::max(most, std::abs(a.pixels[k] - b.pixels[k]));
  return most;
}

// The sheet's settings without a ground, and a sheet far from the picture: nothing but the background.
Image background_of(const Settings& settings, DrawnSheet sheet) {
  sheet.state.position.col(1).array() += 100.0f;
  return draw_sheet(sheet, View::textured, settings);
}

TEST(Alpha, CompositedOverTheBackgroundIsTheOpaqueFrame) {
  const DrawnSheet sheet = wavy_sheet();
  for (const int samples : {1, 4, 16}) {
    Settings settings = sheet_settings();
    settings.ground = false;
    settings.samples = samples;
    const Image opaque = draw_sheet(sheet, View::textured, settings);
    const Image seen = draw_sheet(sheet, View::textured, transparent(settings));
    ASSERT_EQ(seen.channels, 4);
    // Two roundings to 8 bits, one of them magnified where alpha is small, against one.
    EXPECT_LE(largest_difference(composited(seen, background_of(settings, sheet)), opaque), 2) << samples;
    int partial = 0, full = 0, none = 0;
    for (std::size_t p = 3; p < seen.pixels.size(); p += 4)
      ++(seen.pixels[p] == 0 ? none : seen.pixels[p] == 255 ? full : partial);
    EXPECT_GT(full, 1000);
    EXPECT_GT(none, 1000);
    EXPECT_EQ(partial > 0, samples > 1);
  }
}

TEST(Alpha, HasTheColoursOfTheBodyAtItsEdges) {
  Settings settings = test::frontal_settings();
  DrawnSheet sheet = test::flat_sheet();
  sheet.body.finish[0].colour = {0.8f, 0.1f, 0.1f};
  sheet.state.position *= 0.97f;  // edges within pixels
  const Image seen = draw_sheet(sheet, View::textured, transparent(settings));
  const std::uint8_t* middle = seen.row(32) + 4 * 32;
  int edges = 0;
  for (std::size_t p = 0; p < seen.pixels.size(); p += 4) {
    if (seen.pixels[p + 3] == 0 || seen.pixels[p + 3] == 255) continue;
    ++edges;
    EXPECT_NEAR(seen.pixels[p], middle[0], 24);  // and not darker, as colour times alpha would be
  }
  EXPECT_GT(edges, 50);
}

TEST(Alpha, ShadowOnlyIsBlackThatTakesLight) {
  Settings settings = sheet_settings();
  settings.shadow_only = true;
  const DrawnSheet sheet = wavy_sheet();
  const Image seen = draw_sheet(sheet, View::textured, transparent(settings));
  settings.ground = false;
  const Image without = draw_sheet(sheet, View::textured, transparent(settings));
  int shaded = 0;
  for (std::size_t p = 0; p < seen.pixels.size(); p += 4) {
    if (without.pixels[p + 3] != 0 || seen.pixels[p + 3] == 0) continue;
    ++shaded;
    EXPECT_EQ(seen.pixels[p], 0);
    EXPECT_LE(seen.pixels[p + 3], 143);  // 1 - 0.46 of 255, and some rounding
  }
  EXPECT_GT(shaded, 500);
}

TEST(Alpha, TheVelocityViewHasItToo) {
  Settings settings = transparent(sheet_settings());
  settings.velocity_range = 1.0;
  for (const double shading : {0.25, 0.0}) {
    settings.velocity_shading = shading;
    const Image seen = draw_sheet(wavy_sheet(), View::velocity, settings);
    ASSERT_EQ(seen.channels, 4);
    EXPECT_EQ(seen.pixels[3], 0);
    EXPECT_GT(std::count(seen.pixels.begin(), seen.pixels.end(), 255), 1000);
  }
}

}  // namespace
}  // namespace billow::render
