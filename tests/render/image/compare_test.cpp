#include "render/image/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"

namespace billow::render {
namespace {

// Values in [20, 235] without structure: x and y enter through a small linear congruence.
Image noisy(int width, int height, int channels = 3) {
  Image image(width, height, channels);
  unsigned state = 1;
  for (auto& value : image.pixels)
    value = static_cast<std::uint8_t>(20 + (state = state * 1103515245u + 12345u) / 65536u % 216);
  return image;
}

Image offset(Image image, int by) {
  for (auto& value : image.pixels) value = static_cast<std::uint8_t>(value + by);
  return image;
}

TEST(Compare, FindsNothingBetweenEqualImages) {
  const Comparison c = compare(noisy(40, 30), noisy(40, 30));
  EXPECT_EQ(c.max, 0);
  EXPECT_EQ(c.rmse, 0.0);
  EXPECT_EQ(c.psnr, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(c.ssim, 1.0, 1e-12);
  EXPECT_EQ(c.share_over, 0.0);
}

TEST(Compare, GivesAConstantOffsetItsClosedForms) {
  const Comparison c = compare(noisy(40, 30), offset(noisy(40, 30), 10));
  EXPECT_EQ(c.max, 10);
  EXPECT_DOUBLE_EQ(c.mean, 10.0);
  EXPECT_DOUBLE_EQ(c.rmse, 10.0);
  EXPECT_DOUBLE_EQ(c.psnr, 20.0 * std::log10(25.5));
  EXPECT_EQ(c.share_over, 1.0);
  EXPECT_EQ(compare(noisy(40, 30), offset(noisy(40, 30), 10), 10).share_over, 0.0);
}

// Flat images have no variance, so SSIM is its luminance term alone: (2 a b + C1) / (a^2 + b^2 + C1).
TEST(Compare, GivesFlatImagesTheLuminanceTermOfSsim) {
  Image a(20, 20), b(20, 20);
  std::fill(a.pixels.begin(), a.pixels.end(), std::uint8_t{100});
  std::fill(b.pixels.begin(), b.pixels.end(), std::uint8_t{150});
  const double c1 = 2.55 * 2.55;
  EXPECT_NEAR(compare(a, b).ssim, (2.0 * 100 * 150 + c1) / (100.0 * 100 + 150.0 * 150 + c1), 1e-9);
}

TEST(Compare, FindsNoStructureInCommonBetweenAnImageAndItsNegative) {
  Image negative = noisy(40, 30);
  for (auto& value : negative.pixels) value = static_cast<std::uint8_t>(255 - value);
  EXPECT_LT(compare(noisy(40, 30), negative).ssim, -0.5);
}

TEST(Compare, CountsPixelsOverTheThresholdOnce) {
  Image b = noisy(10, 10);
  for (int c = 0; c < 3; ++c) b.row(4)[3 * 7 + c] += 5;
  const Comparison c = compare(noisy(10, 10), b);
  EXPECT_DOUBLE_EQ(c.share_over, 0.01);
  EXPECT_DOUBLE_EQ(c.mean, 15.0 / 300.0);
  EXPECT_TRUE(within_tolerance(c));
}

TEST(Compare, TakesAnImageWithoutAlphaAsOpaque) {
  Image rgb = noisy(5, 4), rgba(5, 4, 4);
  for (int p = 0; p < 20; ++p) {
    for (int c = 0; c < 3; ++c) rgba.pixels[4 * p + c] = rgb.pixels[3 * p + c];
    rgba.pixels[4 * p + 3] = 255;
  }
  EXPECT_EQ(compare(rgb, rgba).max, 0);
  rgba.pixels[3] = 0;
  EXPECT_EQ(compare(rgb, rgba).max, 255);
}

TEST(Compare, WorksOnASinglePixel) { EXPECT_NEAR(compare(noisy(1, 1), noisy(1, 1)).ssim, 1.0, 1e-12); }

TEST(Compare, RefusesDifferentSizes) {
  EXPECT_THROW(compare(noisy(4, 5), noisy(5, 4)), InputError);
  EXPECT_THROW(difference(noisy(4, 5), noisy(5, 4)), InputError);
  EXPECT_THROW(compare(Image(), Image()), InputError);
}

TEST(WithinTolerance, HoldsEachOfItsThreeLimits) {
  EXPECT_TRUE(within_tolerance(compare(noisy(20, 20), offset(noisy(20, 20), 3))));
  EXPECT_FALSE(within_tolerance(compare(noisy(20, 20), offset(noisy(20, 20), 4))));
  Image spot = noisy(20, 20);
  spot.row(3)[3] += 16;
  EXPECT_TRUE(within_tolerance(compare(noisy(20, 20), spot)));
  spot.row(3)[3] += 1;
  EXPECT_FALSE(within_tolerance(compare(noisy(20, 20), spot)));
}

TEST(Difference, IsAmplifiedAndClamped) {
  Image b = noisy(3, 1);
  b.pixels[0] += 2;
  b.pixels[4] -= 60 < b.pixels[4] ? 60 : 0;
  const Image seen = difference(noisy(3, 1), b);
  EXPECT_EQ(seen.pixels[0], 16);
  EXPECT_EQ(seen.pixels[1], 0);
  EXPECT_EQ(seen.pixels[4], noisy(3, 1).pixels[4] > 60 ? 255 : 0);
}

}  // namespace
}  // namespace billow::render
