// ꟻLIP against the authors' own program, closed cases of its pipelines, and its symmetries.
#include "render/image/flip.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "render/image/image.h"

namespace billow::render {
namespace {

// Rows from the top.
std::vector<Eigen::ArrayXd> errors(const Image& reference, const Image& test) {
  std::vector<Eigen::ArrayXd> rows;
  Flip flip(reference.width, reference.height, [&](int y, const Eigen::ArrayXd& row) {
    EXPECT_EQ(y, static_cast<int>(rows.size()));
    rows.push_back(row);
  });
  for (int y = 0; y < reference.height; ++y)
    flip.add_row(reference.row(y), reference.channels, test.row(y), test.channels);
  flip.finish();
  EXPECT_EQ(rows.size(), static_cast<std::size_t>(reference.height));
  return rows;
}

double mean(const Image& reference, const Image& test) {
  double sum = 0.0;
  for (const Eigen::ArrayXd& row : errors(reference, test)) sum += row.sum();
  return sum / (reference.width * reference.height);
}

Image filled(int width, int height, int red, int green, int blue) {
  Image image(width, height);
  for (int p = 0; p < width * height; ++p) {
    image.pixels[3 * p] = static_cast<std::uint8_t>(red);
    image.pixels[3 * p + 1] = static_cast<std::uint8_t>(green);
    image.pixels[3 * p + 2] = static_cast<std::uint8_t>(blue);
  }
  return image;
}

// Colours without structure, by a small linear congruence.
Image noise(int width, int height, unsigned seed) {
  Image image(width, height);
  for (auto& value : image.pixels)
    value = static_cast<std::uint8_t>((seed = seed * 1103515245u + 12345u) / 65536u % 256);
  return image;
}

Image ramp(int width, int height, int step) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) image.row(y)[3 * x + c] = static_cast<std::uint8_t>((x * step + y * (c + 1)) % 256);
  return image;
}

TEST(Flip, FindsNothingBetweenEqualImages) {
  for (const Eigen::ArrayXd& row : errors(noise(30, 25, 1), noise(30, 25, 1))) EXPECT_EQ(row.maxCoeff(), 0.0);
}

// No structure, so the colours alone decide: at the ends of the scale by its definition, in between by its formula.
TEST(Flip, GivesFlatImagesTheErrorOfTheirColours) {
  EXPECT_NEAR(mean(filled(5, 5, 0, 255, 0), filled(5, 5, 0, 0, 255)), 1.0, 1e-12);
  // Greys of L* 42.37 and 42.79: (ΔL*)^0.7 / (0.4 · 41.28) · 0.95.
  EXPECT_NEAR(mean(filled(5, 5, 100, 100, 100), filled(5, 5, 101, 101, 101)), 0.0308, 0.0001);
}

TEST(Flip, IsTheSameBothWays) {
  EXPECT_NEAR(mean(noise(40, 30, 1), ramp(40, 30, 5)), mean(ramp(40, 30, 5), noise(40, 30, 1)), 1e-12);
}

TEST(Flip, IgnoresAlpha) {
  Image with_alpha(20, 10, 4);
  const Image without = noise(20, 10, 3);
  for (int p = 0; p < 200; ++p) {
    for (int c = 0; c < 3; ++c) with_alpha.pixels[4 * p + c] = without.pixels[3 * p + c];
    with_alpha.pixels[4 * p + 3] = static_cast<std::uint8_t>(p);
  }
  EXPECT_EQ(mean(with_alpha, without), 0.0);
}

// What version 1.6 of the authors' own program (github.com/NVlabs/flip, in single precision) gives for the same images.
TEST(Flip, AgreesWithItsAuthorsProgram) {
  struct Case {
    Image reference, test;
    double mean, first, middle, last;
  };
  const Case cases[] = {{noise(40, 30, 1), ramp(40, 30, 5), 0.683737, 0.964848, 0.337343, 0.969916},
                        {ramp(64, 48, 3), ramp(64, 48, 4), 0.521336, 0.013713, 0.444508, 0.957537},
                        {ramp(300, 20, 1), ramp(300, 20, 2), 0.616856, 0.013109, 0.855727, 0.496672},
                        {noise(7, 5, 1), noise(7, 5, 2), 0.498332, 0.616890, 0.472657, 0.708259},
                        {noise(1, 1, 1), noise(1, 1, 7), 0.739243, 0.739243, 0.739243, 0.739243}};
  for (const Case& c : cases) {
    const std::string name = std::to_string(c.reference.width) + " x " + std::to_string(c.reference.height);
    const auto rows = errors(c.reference, c.test);
    EXPECT_NEAR(mean(c.reference, c.test), c.mean, 5e-5) << name;
    EXPECT_NEAR(rows.front()(0), c.first, 1e-4) << name;
    EXPECT_NEAR(rows[rows.size() / 2](c.reference.width / 2), c.middle, 1e-4) << name;
    EXPECT_NEAR(rows.back()(c.reference.width - 1), c.last, 1e-4) << name;
  }
}

}  // namespace
}  // namespace billow::render
