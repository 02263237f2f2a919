#include "render/gl/pixel_box.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace billow::render {
namespace {

using testing::ElementsAre;

TEST(PixelBox, OverlapIsWhatBothHave) {
  const PixelBox a{0, 0, 10, 10}, b{5, -3, 20, 4};
  EXPECT_EQ(overlap(a, b), (PixelBox{5, 0, 10, 4}));
  EXPECT_TRUE(overlap(a, {10, 0, 12, 5}).empty());
}

TEST(SplitEvenly, KeepsWholeWhatFits) {
  EXPECT_THAT(split_evenly(31, 17, 31, 17), ElementsAre(PixelBox{0, 0, 31, 17}));
}

TEST(SplitEvenly, MakesTheFewestBoxesOfAboutOneSize) {
  EXPECT_THAT(split_evenly(101, 10, 100, 100), ElementsAre(PixelBox{0, 0, 52, 10}, PixelBox{52, 0, 101, 10}));
}

// Every pixel lies in one box; boxes begin at even pixels and are no larger than is allowed.
TEST(SplitEvenly, CoversEveryPixelOnce) {
  for (const auto& [width, height, most] : {std::array{97, 53, 16}, {64, 64, 2}, {1, 1, 4}, {640, 481, 250}}) {
    int pixels = 0;
    for (const PixelBox& box : split_evenly(width, height, most, most)) {
      pixels += box.width() * box.height();
      EXPECT_EQ(box.left % 2 + box.bottom % 2, 0);
      EXPECT_TRUE(0 < box.width() && box.width() <= most && 0 < box.height() && box.height() <= most);
      EXPECT_EQ(overlap(box, {0, 0, width, height}), box);
    }
    EXPECT_EQ(pixels, width * height);
  }
}

}  // namespace
}  // namespace billow::render
