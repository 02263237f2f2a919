#include "render/image/colour_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace billow::render {
namespace {

TEST(VelocityRgb, IsTheFormulaRoundedToBytes) {
  EXPECT_EQ(velocity_rgb({0, 0, 0}, 2.0), (Rgb8{128, 128, 128}));  // 127.5 rounds up
  EXPECT_EQ(velocity_rgb({2, -2, 1}, 2.0), (Rgb8{255, 0, 191}));   // 255 * 3/4 = 191.25
  EXPECT_EQ(velocity_rgb({-1, 0.5, -0.5}, 2.0), (Rgb8{64, 159, 96}));
}

TEST(VelocityRgb, ClampsBeyondTheRange) { EXPECT_EQ(velocity_rgb({9, -9, 1e300}, 1.0), (Rgb8{255, 0, 255})); }

TEST(MagnitudeRgb, PassesThroughViridis) {
  EXPECT_EQ(magnitude_rgb(0.0), (Rgb8{68, 1, 84}));
  EXPECT_EQ(magnitude_rgb(1.0), (Rgb8{253, 231, 37}));
  EXPECT_EQ(magnitude_rgb(51.0 / 255.0), (Rgb8{65, 68, 135}));
  const Rgb8 middle = magnitude_rgb(128.0 / 255.0), viridis{33, 145, 140};  // between two of the table's entries
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(middle[c], viridis[c], 4);
}

TEST(MagnitudeRgb, ClampsAndGrowsLighterAllTheWay) {
  EXPECT_EQ(magnitude_rgb(-3.0), magnitude_rgb(0.0));
  EXPECT_EQ(magnitude_rgb(7.0), magnitude_rgb(1.0));
  double last = -1.0;
  for (int i = 0; i <= 64; ++i) {
    const Rgb8 c = magnitude_rgb(i / 64.0);
    const double luminance = 0.2126 * std::pow(c[0], 2.2) + 0.7152 * std::pow(c[1], 2.2) + 0.0722 * std::pow(c[2], 2.2);
    EXPECT_GT(luminance, last) << "at " << i;
    last = luminance;
  }
}

}  // namespace
}  // namespace billow::render
