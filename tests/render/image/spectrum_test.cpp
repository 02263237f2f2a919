// The spectrum against waves whose spectrum is known.
#include "render/image/spectrum.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/drawn/flat_layout.h"
#include "sim/drawn/grid_sampling.h"
#include "sim/import/mesh_import.h"

namespace billow::render {
namespace {

constexpr int width = 24, height = 18;

/// A wave along x and y of so many cycles per side in the z component.
Eigen::MatrixX3d wave(int cycles_x, int cycles_y, double amplitude) {
  Eigen::MatrixX3d velocity = Eigen::MatrixX3d::Zero(width * height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double turn = static_cast<double>(cycles_x) * x / width + static_cast<double>(cycles_y) * y / height;
      velocity(y * width + x, 2) = amplitude * std::cos(2.0 * std::numbers::pi * turn);
    }
  return velocity;
}

// A cos(k x) has the power A^2 / 4 at k and at -k.
TEST(Spectrum, OfAWaveIsTwoPeaks) {
  const Spectrum spectrum = spectrum_of(wave(5, -3, 2.0), width, height);
  EXPECT_NEAR(spectrum.power(height / 2 - 3, width / 2 + 5), 1.0, 1e-12);
  EXPECT_NEAR(spectrum.power(height / 2 + 3, width / 2 - 5), 1.0, 1e-12);
  EXPECT_NEAR(spectrum.power.sum(), 2.0, 1e-12);
}

TEST(Spectrum, OfRestButOneVelocityIsTheZeroFrequency) {
  const Eigen::MatrixX3d velocity = Eigen::RowVector3d(1.0, 2.0, 2.0).replicate(width * height, 1);
  const Spectrum spectrum = spectrum_of(velocity, width, height);
  EXPECT_NEAR(spectrum.power(height / 2, width / 2), 9.0, 1e-12);
  EXPECT_NEAR(radial_power(spectrum)(0), 9.0, 1e-12);
}

// Parseval: the powers sum to the mean square speed, in the plane and by radius.
TEST(Spectrum, KeepsTheMeanSquareSpeed) {
  const Eigen::MatrixX3d velocity = wave(1, 2, 0.7) + wave(6, 0, 0.2) + wave(11, 9, 1.1);
  const double mean_square = velocity.squaredNorm() / velocity.rows();
  const Spectrum spectrum = spectrum_of(velocity, width, height);
  EXPECT_NEAR(spectrum.power.sum(), mean_square, 1e-12);
  EXPECT_NEAR(radial_power(spectrum).sum(), mean_square, 1e-12);
}

TEST(Spectrum, RadiallyStandsAtItsWholeFrequency) {
  const Eigen::VectorXd radial = radial_power(spectrum_of(wave(3, 4, 2.0), width, height));
  EXPECT_NEAR(radial(5), 2.0, 1e-12);
  EXPECT_NEAR(radial.sum() - radial(5), 0.0, 1e-12);
}

// An image turned by a quarter has its spectrum turned by a quarter: place (y, x) about the middle goes to (x, -y). The
// side is odd, so that the middle stays where it is.
TEST(Spectrum, TurnsWithTheImage) {
  constexpr int side = 15;
  Eigen::MatrixX3d image = Eigen::MatrixX3d::Zero(side * side, 3), turned = image;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      image.row(y * side + x) << std::sin(0.3 * x * y), std::cos(1.1 * x), 0.1 * y;
      turned.row(x * side + side - 1 - y) = image.row(y * side + x);
    }
  const Spectrum before = spectrum_of(image, side, side), after = spectrum_of(turned, side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) EXPECT_NEAR(after.power(x, side - 1 - y), before.power(y, x), 1e-12);
  EXPECT_LT((radial_power(after) - radial_power(before)).norm(), 1e-12);
}

// A slope across the image jumps where the image is taken to go on: without a window its ring 8 holds power that no
// motion has.
TEST(Spectrum, WindowTakesAwayWhatTheBorderAdds) {
  constexpr int side = 40;
  Eigen::MatrixX3d slope(side * side, 3);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) slope.row(y * side + x) << 0.1 * x, 0.2 * y, 1.0;
  const Eigen::VectorXd bare = radial_power(spectrum_of(slope, side, side));
  const Eigen::VectorXd windowed = radial_power(spectrum_of(slope, side, side, Window::hann));
  EXPECT_GT(bare(8), 0.01);
  EXPECT_LT(windowed(8), 1e-3 * bare(8));
}

// What does not jump stays: a wave's power, spread over its neighbours, and the mean.
TEST(Spectrum, WindowKeepsWavesAndTheMean) {
  Eigen::MatrixX3d velocity = wave(6, 0, 2.0);
  velocity.col(0).setConstant(3.0);
  const Spectrum spectrum = spectrum_of(velocity, width, height, Window::hann);
  EXPECT_NEAR(spectrum.power(height / 2, width / 2), 9.0, 1e-6);
  EXPECT_NEAR(spectrum.power.block(height / 2 - 1, width / 2 + 5, 3, 3).sum(), 1.0, 1e-6);
  EXPECT_NEAR(spectrum.power.sum(), 11.0, 1e-6);
}

// The same motion of a cloth, whatever its mesh.
Eigen::VectorXd radial_power_of_a_ripple(const std::string& mesh_name) {
  const sim::Mesh mesh = sim::import_mesh(std::filesystem::path(BILLOW_SOURCE_DIR) / "assets/meshes" / mesh_name);
  const Eigen::MatrixX2d place = sim::flat_layout(mesh).vertex;
  Eigen::MatrixX3d velocity(mesh.vertices(), 3);
  for (int v = 0; v < mesh.vertices(); ++v) {
    const double across = std::pow(std::sin(std::numbers::pi * place(v, 0)), 2);
    const double down = std::pow(std::sin(std::numbers::pi * place(v, 1)), 2);
    velocity.row(v) << across * down, across * down * std::cos(10.0 * place(v, 0)), down * std::sin(20.0 * place(v, 1));
  }
  const sim::GridSampling grid = sim::grid_sampling(mesh);
  return radial_power(spectrum_of(grid.sample(velocity), grid.width, grid.height));
}

TEST(Spectrum, OfAnIrregularMeshIsNearlyThatOfAGrid) {
  const Eigen::VectorXd grid = radial_power_of_a_ripple("cloth_50.obj");
  const Eigen::VectorXd irregular = radial_power_of_a_ripple("cloth_irregular.obj");
  for (int r = 0; r <= 5; ++r) EXPECT_NEAR(irregular(r), grid(r), 0.1 * grid(r)) << r;
}

TEST(Spectrum, MeanIsOfPowers) {
  SpectrumMean mean;
  EXPECT_TRUE(mean.empty());
  mean.add(spectrum_of(wave(2, 0, 2.0), width, height));
  mean.add(spectrum_of(wave(4, 0, 2.0), width, height));
  EXPECT_NEAR(radial_power(mean.mean())(2), 1.0, 1e-12);
  EXPECT_NEAR(radial_power(mean.mean())(4), 1.0, 1e-12);
}

// 20 dB below the strongest is half way down a range of 40.
TEST(Spectrum, PictureIsLogarithmic) {
  Spectrum spectrum{Eigen::MatrixXd::Zero(1, 3)};
  spectrum.power << 1.0, 0.01, 1e-9;
  const Image picture = spectrum_picture(spectrum, 40.0);
  EXPECT_EQ(picture.pixels[0], 255);
  EXPECT_EQ(picture.pixels[3], 128);
  EXPECT_EQ(picture.pixels[6], 0);
}

TEST(Spectrum, VelocityPictureHasAPixelPerCell) {
  Eigen::MatrixX3d velocity(2, 3);
  velocity << 0.0, 0.0, 0.0, 2.0, -2.0, 0.0;
  const Image picture = velocity_picture(velocity, 2, 1, 2.0);
  EXPECT_EQ(picture.pixels, (std::vector<std::uint8_t>{128, 128, 128, 255, 0, 128}));
}

TEST(Window, HasItsWords) {
  EXPECT_EQ(word_of(Window::none), "none");
  EXPECT_EQ(word_of(Window::hann), "hann");
  EXPECT_THAT(all_words<Window>(), testing::ElementsAre("none", "hann"));
}

}  // namespace
}  // namespace billow::render
