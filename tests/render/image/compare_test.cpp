#include "render/image/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

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
  EXPECT_EQ(compare(noisy(40, 30), offset(noisy(40, 30), 10), {.threshold = 10}).share_over, 0.0);
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

// Also where one colour meets another of the same lightness.
TEST(Compare, FindsEdgesInAnyChannel) {
  const auto halves = [](int border) {
    Image image(20, 10);
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 20; ++x) {
        image.row(y)[3 * x] = x < border ? 60 : 120;
        image.row(y)[3 * x + 1] = x < border ? 130 : 120;
        image.row(y)[3 * x + 2] = x < border ? 200 : 124;
      }
    return image;
  };
  EXPECT_EQ(compare(halves(10), halves(11)).over, 10);
  EXPECT_EQ(compare(halves(10), halves(11)).over_off_edges, 0);
  EXPECT_EQ(compare(halves(10), halves(12)).over_off_edges, 20);  // each column touches one of the edges only
}

// Wang et al.'s windows one by one, as their paper has them.
double direct_ssim(const Image& a, const Image& b) {
  const auto luma = [](const Image& image, int x, int y) {
    const std::uint8_t* p = image.row(y) + x * image.channels;
    return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
  };
  const double c1 = 2.55 * 2.55, c2 = 7.65 * 7.65;
  double sum = 0.0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      double weight = 0.0, ma = 0.0, mb = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
      for (int v = std::max(y - 5, 0); v <= std::min(y + 5, a.height - 1); ++v)
        for (int u = std::max(x - 5, 0); u <= std::min(x + 5, a.width - 1); ++u) {
          const double w = std::exp(-((u - x) * (u - x) + (v - y) * (v - y)) / 4.5);
          const double p = luma(a, u, v), q = luma(b, u, v);
          weight += w, ma += w * p, mb += w * q, aa += w * p * p, bb += w * q * q, ab += w * p * q;
        }
      ma /= weight, mb /= weight;
      const double va = aa / weight - ma * ma, vb = bb / weight - mb * mb, cov = ab / weight - ma * mb;
      sum += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
    }
  return sum / (a.width * a.height);
}

// Smaller than a window, as large as one, and past a block of the rows' sums.
TEST(Compare, GivesTheSimilarityOfWindowsOneByOne) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 9}, {11, 11}, {7, 40}, {521, 13}}) {
    Image b = noisy(width, height);
    for (std::size_t k = 0; k < b.pixels.size(); k += 7) b.pixels[k] /= 2;
    EXPECT_NEAR(compare(noisy(width, height), b).ssim, direct_ssim(noisy(width, height), b), 1e-12)
        << width << " x " << height;
  }
}

// A half plane whose border lies at `border`, with the mixed pixel that sampling makes of it.
Image half_plane(double border, int extra_x = -1) {
  Image image(20, 10);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 20; ++x)
      for (int c = 0; c < 3; ++c) {
        const double share = std::clamp(border + 0.3 * y - x, 0.0, 1.0);
        image.row(y)[3 * x + c] = static_cast<std::uint8_t>(std::lround(200.0 - 150.0 * share));
      }
  if (extra_x >= 0) image.row(5)[3 * extra_x] = 90;
  return image;
}

TEST(Edge, ExplainsASilhouetteThatIsUpToAPixelAside) {
  for (const double by : {0.1, 0.5, 0.99, 1.0}) {
    EXPECT_GT(compare(half_plane(8), half_plane(8 + by)).over, 0) << by;
    const Comparison c = compare(half_plane(8), half_plane(8 + by), {.edge = 1});
    EXPECT_EQ(c.over, 0) << by;
    EXPECT_EQ(c.max, 0) << by;
    EXPECT_EQ(c.explained, compare(half_plane(8), half_plane(8 + by)).over) << by;
  }
  EXPECT_GT(compare(half_plane(8), half_plane(10), {.edge = 1}).over, 0);
  EXPECT_EQ(compare(half_plane(8), half_plane(10), {.edge = 2}).over, 0);
}

TEST(Edge, ExplainsNothingThatOnlyOneImageHas) {
  EXPECT_EQ(compare(half_plane(8), half_plane(8, 17), {.edge = 1}).over, 1);
  EXPECT_EQ(compare(half_plane(8, 17), half_plane(8), {.edge = 1}).over, 1);
  EXPECT_EQ(compare(half_plane(8, 17), half_plane(8, 16), {.edge = 1}).over, 0);  // but moved by a pixel
  EXPECT_EQ(compare(noisy(20, 20), offset(noisy(20, 20), 20), {.edge = 0}).over, 400);
  Image flat(20, 20), lighter(20, 20);
  std::fill(lighter.pixels.begin(), lighter.pixels.end(), std::uint8_t{10});
  EXPECT_EQ(compare(flat, lighter, {.edge = 4}).over, 400);
}

// Each pixel's window by hand.
TEST(Edge, IsWhatWindowsOneByOneSay) {
  const Image a = noisy(23, 17);
  Image b = a;
  for (std::size_t k = 0; k < b.pixels.size(); k += 3) b.pixels[k] = static_cast<std::uint8_t>(255 - b.pixels[k]);
  const auto beyond = [](const Image& image, int value, int x, int y, int c, int radius) {
    int low = 255, high = 0;
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, image.height - 1); ++v)
      for (int u = std::max(x - radius, 0); u <= std::min(x + radius, image.width - 1); ++u) {
        low = std::min<int>(low, image.row(v)[3 * u + c]);
        high = std::max<int>(high, image.row(v)[3 * u + c]);
      }
    return std::max({0, low - value, value - high});
  };
  for (const int radius : {1, 2, 4}) {
    double sum = 0.0;
    int most = 0;
    for (int y = 0; y < 17; ++y)
      for (int x = 0; x < 23; ++x)
        for (int c = 0; c < 3; ++c) {
          const int left = std::max(beyond(b, a.row(y)[3 * x + c], x, y, c, radius),
                                    beyond(a, b.row(y)[3 * x + c], x, y, c, radius));
          sum += left;
          most = std::max(most, left);
        }
    const Comparison c = compare(a, b, {.edge = radius});
    EXPECT_EQ(c.max, most) << radius;
    EXPECT_NEAR(c.mean, sum / (23 * 17 * 3), 1e-12) << radius;
  }
}

// Pairs of values of one channel, in a row.
Comparison compare_floats(const std::vector<double>& a, const std::vector<double>& b,
                          const ComparisonOptions& options = {}, Meaning meaning = Meaning::quantity) {
  const int width = static_cast<int>(a.size());
  RowComparison comparison(RowShape{width, 1, 0, 0, Depth::floats, {{"Z", meaning}}}, options);
  comparison.add_row(ValueRow(Eigen::Map<const Eigen::ArrayXd>(a.data(), width)),
                     ValueRow(Eigen::Map<const Eigen::ArrayXd>(b.data(), width)));
  return comparison.finish();
}

TEST(CompareFloats, AreApartAbsolutelyBelowOneAndInProportionAbove) {
  const Comparison c = compare_floats({0.0, 0.5, 300.0, 300.0}, {0.01, 0.52, 303.0, 306.0});
  EXPECT_EQ(c.over, 2);  // 0.02 and 6 of 306 are over 3/255, 0.01 and 3 of 303 are not
  EXPECT_DOUBLE_EQ(c.max, 6.0);
  EXPECT_NEAR(c.apart, 255.0 * 0.02, 1e-9);
  EXPECT_NEAR(c.mean, (0.01 + 0.02 + 3.0 + 6.0) / 4.0, 1e-12);
  EXPECT_TRUE(std::isnan(c.ssim));
  EXPECT_EQ(c.worst_channel, "Z");
  EXPECT_EQ(c.worst_x, 1);
}

TEST(CompareFloats, TakeNanAndInfinityForValues) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Comparison same = compare_floats({nan, inf, -inf, 1.0}, {nan, inf, -inf, 1.0});
  EXPECT_EQ(same.over, 0);
  EXPECT_EQ(same.both_nan, 1);
  EXPECT_EQ(difference_text(same, 3), "equal, 1 value NaN in both");
  const Comparison c = compare_floats({nan, inf, 2.0, 1.0}, {1.0, -inf, inf, 1.5});
  EXPECT_EQ(c.not_finite, 3);
  EXPECT_EQ(c.over, 4);
  EXPECT_EQ(c.max, 0.5);
  EXPECT_EQ(c.rmse, 0.5);  // of what is finite
  EXPECT_FALSE(within_tolerance(c, {.worst = 255, .share = 1}));
  EXPECT_FALSE(within_tolerance(c, {.metrics = {{Metric::rmse, 10.0}}}));
  EXPECT_EQ(difference_text(c, 3),
            "4 px over 0.0118 (100 %), worst infinite in Z at (0, 0): nan and 1, 1 off any edge, 3 values NaN "
            "or infinite in one alone");
  // A silhouette before nothing, a pixel aside.
  EXPECT_EQ(compare_floats({inf, inf, 2.0, 2.0}, {inf, 2.0, 2.0, 2.0}, {.edge = 1}).over, 0);
}

TEST(CompareFloats, KnowIdentitiesOnlyAsTheSameOrNot) {
  EXPECT_EQ(compare_floats({1e-20}, {2e-20}).over, 0);
  const Comparison c = compare_floats({1e-20, 3.0, 7.0}, {1e-20, 3.0, 9e30}, {}, Meaning::number);
  EXPECT_EQ(c.apart, 255.0);
  EXPECT_EQ(c.max, 1.0);
  EXPECT_DOUBLE_EQ(c.mean, 1.0 / 3.0);
  EXPECT_EQ(compare_floats({1, 1, 3, 3}, {1, 3, 3, 3}, {.edge = 1}, Meaning::number).over, 0);
  EXPECT_EQ(compare_floats({1, 1, 3, 3}, {1, 2, 3, 3}, {.edge = 1}, Meaning::number).over,
            1);  // 2 is nothing between 1 and 3
}

TEST(CompareFloats, SayWhichIdentitiesTheyAre) {
  const auto hash = [](std::uint32_t bits) { return static_cast<double>(std::bit_cast<float>(bits)); };
  const Comparison hashes = compare_floats({1, hash(0x8f6a5164)}, {1, hash(0x0042abcd)}, {}, Meaning::hash);
  EXPECT_EQ(difference_text(hashes, 3),
            "1 px over 0.0118 (50 %), another hash in Z at (1, 0): 8f6a5164 and 0042abcd, all within 1 px of an edge");
  EXPECT_EQ(broken_limits(hashes, {.share = 1}), "");
  EXPECT_FALSE(within_tolerance(hashes, {.share = 1}));
  const Comparison numbers = compare_floats({7, 4000000000}, {7, 4000000001}, {}, Meaning::number);
  EXPECT_THAT(difference_text(numbers, 3),
              testing::HasSubstr("another number in Z at (1, 0): 4000000000 and 4000000001"));
}

// A depth that ends between the second pixel and the third, and a velocity of which one differs.
TEST(CompareFloats, LookForEdgesInWhatDiffers) {
  const auto over_off_edges = [](int differs, double by) {
    RowComparison comparison(RowShape{4, 1, 0, 0, Depth::floats, {{"Z"}, {"v.X"}, {"v.Y"}}}, {});
    ValueRow a(4, 3), b(4, 3);
    a << 1, 0.1, 0.2, 1, 0.1, 0.2, 5, 0.1, 0.2, 5, 0.1, 0.2;
    b = a;
    b(2, differs) += by;
    comparison.add_row(a, b);
    return comparison.finish().over_off_edges;
  };
  EXPECT_EQ(over_off_edges(0, 0.5), 0);
  EXPECT_EQ(over_off_edges(1, 0.05), 1);
}

TEST(Tolerance, SaysWhatItWouldAllow) {
  const auto broken = [](const Tolerance& tolerance) {
    return broken_limits(compare_floats({0.0, 0.5, 300.0}, {0.3, 0.5, 330.0}), tolerance);
  };
  EXPECT_EQ(broken({}), "allowed: 0 px over, worst 0.06275");
  EXPECT_EQ(broken({.worst = 100}), "allowed: 0 px over");
  EXPECT_EQ(broken({.pixels = 1}), "allowed: 1 px over, worst 0.06275");
  EXPECT_EQ(broken({.worst = 100, .pixels = 2}), "");
  EXPECT_EQ(broken_limits(compare_floats({300.0}, {330.0}), {}), "allowed: 0 px over, worst 20.71");  // 16/255 of 330
  EXPECT_EQ(broken({.metrics = {{Metric::max, 100}, {Metric::max, 1}}}), "max 30 and not at most 1");
}

TEST(Difference, IsAmplifiedAndClamped) {
  const std::uint8_t a[] = {20, 30, 40, 255, 100, 50, 60, 0}, b[] = {22, 30, 40, 10, 55, 60};
  std::uint8_t seen[6];
  difference_row(a, 4, b, 3, 2, seen);
  EXPECT_THAT(seen, testing::ElementsAre(16, 0, 0, 255, 40, 0));
}

}  // namespace
}  // namespace billow::render
