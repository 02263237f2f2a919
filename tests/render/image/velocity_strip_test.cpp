#include "render/image/velocity_strip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "render/image/colour_map.h"
#include "render/image/png.h"
#include "tests/support/mesh_files.h"

namespace billow::render {
namespace {

Eigen::MatrixX3d velocities(int particles, int column) {
  Eigen::MatrixX3d velocity(particles, 3);
  for (int p = 0; p < particles; ++p)
    for (int axis = 0; axis < 3; ++axis) velocity(p, axis) = 3.0 * std::sin(0.7 * p + 0.013 * column + 2.0 * axis);
  return velocity;
}

// Every pixel of the file against the colour map itself.
void expect_exact(const Image& strip, const std::vector<int>& order, double range) {
  for (int x = 0; x < strip.width; ++x) {
    const Eigen::MatrixX3d velocity = velocities(static_cast<int>(order.size()), x);
    for (int y = 0; y < strip.height; ++y) {
      const Rgb8 wanted = velocity_rgb(velocity.row(order[y]).transpose(), range);
      ASSERT_TRUE(std::equal(wanted.begin(), wanted.end(), strip.row(y) + 3 * x)) << x << ", " << y;
    }
  }
}

void record(VelocityStrip& strip, int particles, int columns) {
  for (int c = 0; c < columns; ++c) strip.add_column(velocities(particles, c));
}

TEST(VelocityStrip, IsPixelExactInTheGivenOrder) {
  const test::TemporaryFolder folder;
  const std::vector<int> order{3, 0, 4, 1, 2};
  VelocityStrip strip(folder.path() / "strip.png", order, 2.5);
  record(strip, 5, 17);
  EXPECT_EQ(strip.columns(), 17);
  strip.finish();
  const Image image = read_png(folder.path() / "strip.png");
  ASSERT_EQ(image.width, 17);
  ASSERT_EQ(image.height, 5);
  expect_exact(image, order, 2.5);
}

// 7000 columns of 4000 particles are 84 MB: many blocks of rows, and a last tile that is not full.
TEST(VelocityStrip, IsExactAcrossItsBlocks) {
  const test::TemporaryFolder folder;
  std::vector<int> order(4000);
  for (int r = 0; r < 4000; ++r) order[r] = (r * 7) % 4000;
  VelocityStrip strip(folder.path() / "strip.png", order, 3.0);
  const Eigen::MatrixX3d even = velocities(4000, 0), odd = velocities(4000, 1);
  for (int c = 0; c < 7000; ++c) strip.add_column(c % 2 == 0 ? even : odd);
  strip.finish();
  const Image image = read_png(folder.path() / "strip.png");
  ASSERT_EQ(image.width, 7000);
  for (int y = 0; y < 4000; ++y)
    for (const int x : {0, 1, 3500, 6999}) {
      const Rgb8 wanted = velocity_rgb((x % 2 == 0 ? even : odd).row(order[y]).transpose(), 3.0);
      ASSERT_TRUE(std::equal(wanted.begin(), wanted.end(), image.row(y) + 3 * x)) << x << ", " << y;
    }
}

TEST(VelocityStrip, LeavesNothingBehindUnlessFinished) {
  const test::TemporaryFolder folder;
  {
    VelocityStrip strip(folder.path() / "strip.png", {0}, 1.0);
    record(strip, 1, 3);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));  // not even a name while it is being recorded
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(VelocityStrip, CanBeFinishedTwiceAndGoOn) {
  const test::TemporaryFolder folder;
  VelocityStrip strip(folder.path() / "strip.png", {0, 1}, 1.0);
  record(strip, 2, 3);
  strip.finish();
  strip.add_column(velocities(2, 3));
  strip.finish();
  const Image image = read_png(folder.path() / "strip.png");
  ASSERT_EQ(image.width, 4);
  expect_exact(image, {0, 1}, 1.0);
}

TEST(VelocityStrip, RefusesAFolderThatIsNotThereAndAnEmptyPicture) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(VelocityStrip(folder.path() / "absent" / "strip.png", {0}, 1.0), OutputError);
  VelocityStrip strip(folder.path() / "strip.png", {0}, 1.0);
  EXPECT_THROW(strip.finish(), OutputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace billow::render
