// The velocity view's scale: what it says, and that it fits every frame and can be read there.
#include "render/paper/legend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "render/image/colour_map.h"
#include "tests/support/golden.h"

namespace billow::render {
namespace {

using testing::ElementsAre;

constexpr std::array<VelocityColour, 2> colours{VelocityColour::components, VelocityColour::magnitude};

Image plain(int width, int height, std::uint8_t grey) {
  Image image(width, height);
  std::fill(image.pixels.begin(), image.pixels.end(), grey);
  return image;
}

Image labelled(VelocityColour colour, int width, int height, std::uint8_t grey) {
  Image frame = plain(width, height, grey);
  add_legend(frame, draw_legend(colour, 2.312, width, height));
  return frame;
}

// Share of the frame that is no longer as it was.
double covered(const Image& frame, std::uint8_t grey) {
  long changed = 0;
  for (std::size_t p = 0; p < frame.pixels.size(); p += 3)
    changed += frame.pixels[p] != grey || frame.pixels[p + 1] != grey || frame.pixels[p + 2] != grey;
  return static_cast<double>(changed) / (static_cast<double>(frame.width) * frame.height);
}

TEST(Legend, SaysBothEndsAndTheMiddle) {
  EXPECT_THAT(legend_numbers(VelocityColour::components, 2.312), ElementsAre("\u22122.31", "0", "+2.31"));
  EXPECT_THAT(legend_numbers(VelocityColour::magnitude, 2.312), ElementsAre("0", "1.16", "2.31"));
  EXPECT_THAT(legend_numbers(VelocityColour::components, 4e-5), ElementsAre("\u22124 × 10⁻⁵", "0", "+4 × 10⁻⁵"));
}

// A film's, a phone's, a banner's: never much of it, and nothing where it could not be read.
TEST(Legend, TakesASmallShareOfEveryFrame) {
  constexpr std::array<std::array<int, 2>, 12> sizes{{{160, 90},
                                                      {320, 180},
                                                      {640, 360},
                                                      {854, 480},
                                                      {1280, 720},
                                                      {3840, 2160},
                                                      {180, 320},
                                                      {720, 1280},
                                                      {128, 128},
                                                      {512, 512},
                                                      {1024, 1024},
                                                      {2000, 200}}};
  for (const VelocityColour colour : colours)
    for (const auto& [width, height] : sizes) {
      SCOPED_TRACE(testing::Message() << width << " x " << height);
      const double share = covered(labelled(colour, width, height, 60), 60);
      EXPECT_GT(share, 0.004);
      EXPECT_LT(share, width < 200 ? 0.15 : 0.055);
    }
  for (const VelocityColour colour : colours) EXPECT_EQ(draw_legend(colour, 1.0, 64, 36).width, 0);
  EXPECT_EQ(covered(labelled(VelocityColour::components, 64, 36, 60), 60), 0.0);
}

TEST(Legend, GrowsWithTheFrame) {
  for (const VelocityColour colour : colours) {
    const Image one = draw_legend(colour, 1.0, 1280, 720), three = draw_legend(colour, 1.0, 3840, 2160);
    EXPECT_NEAR(three.width, 3 * one.width, 3);
    EXPECT_NEAR(three.height, 3 * one.height, 3);
  }
}

// What lies below makes no difference that an eye would see, be it black or white.
TEST(Legend, CanBeReadOverAnything) {
  for (const VelocityColour colour : colours)
    for (const int width : {320, 1280}) {
      const int height = width * 9 / 16;
      const Image black = labelled(colour, width, height, 0), white = labelled(colour, width, height, 255);
      const Image legend = draw_legend(colour, 2.312, width, height);
      for (int y = 0; y < legend.height; ++y)
        for (int x = 0; x < legend.width; ++x) {
          const std::uint8_t* over = legend.row(y) + 4 * x;
          if (over[3] < 240) continue;  // its rounded corners, and beside them
          const std::size_t at = 3 * (static_cast<std::size_t>(height - legend.height + y) * width + x);
          ASSERT_LE(std::abs(white.pixels[at] - black.pixels[at]), 15);
        }
    }
}

// The ends of the bars have the colours that the view has at v_max along each axis.
TEST(Legend, ShowsTheColoursOfTheRangesEnds) {
  const Image legend = draw_legend(VelocityColour::components, 2.312, 1280, 720);
  const auto nearest = [&](const Rgb8& wanted) {
    int least = 255;
    for (std::size_t p = 0; p < legend.pixels.size(); p += 4) {
      int most = 0;
      for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(legend.pixels[p + c] - wanted[c]));
      least = std::min(least, most);
    }
    return least;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const double end : {-2.312, 2.312})
      EXPECT_LE(nearest(velocity_rgb(end * Eigen::Vector3d::Unit(axis), 2.312)), 2) << axis << " " << end;
}

TEST(Legend, LooksAsItLookedBefore) {
  Image page = plain(1280, 720, 60);
  add_legend(page, draw_legend(VelocityColour::components, 2.312, 1280, 720));
  Image corner(280, 160);
  for (int y = 0; y < corner.height; ++y)
    std::copy_n(page.row(page.height - corner.height + y), 3 * corner.width, corner.row(y));
  EXPECT_GOLDEN(corner, "legend_block");
  EXPECT_GOLDEN(labelled(VelocityColour::components, 320, 90, 60), "legend_line");
}

}  // namespace
}  // namespace billow::render
