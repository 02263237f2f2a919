// Image metrics.
#include "render/image/compare.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/error.h"

namespace billow::render {
namespace {

constexpr int window_radius = 5;      // an 11 x 11 window
constexpr double window_sigma = 1.5;  // [pixel]

int channel(const Image& image, int x, int y, int c) {
  return c < image.channels ? image.row(y)[x * image.channels + c] : 255;
}

void require_same_size(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height)
    throw InputError(
        fmt::format("the images differ in size: {} x {} and {} x {}", a.width, a.height, b.width, b.height));
  if (a.pixels.empty()) throw InputError("the images have no pixels");
}

// Rec. 709 weights on the encoded values, as image metrics do.
Eigen::ArrayXXd luma(const Image& image) {
  Eigen::ArrayXXd result(image.height, image.width);
  for (int x = 0; x < image.width; ++x)
    for (int y = 0; y < image.height; ++y)
      result(y, x) =
          0.2126 * channel(image, x, y, 0) + 0.7152 * channel(image, x, y, 1) + 0.0722 * channel(image, x, y, 2);
  return result;
}

// Gaussian mean over the rows of each column; near the border over the part of the window that lies inside.
Eigen::ArrayXXd blurred_down(const Eigen::ArrayXXd& image) {
  Eigen::ArrayXXd sum = Eigen::ArrayXXd::Zero(image.rows(), image.cols());
  Eigen::ArrayXd weight = Eigen::ArrayXd::Zero(image.rows());
  for (Eigen::Index offset = -window_radius; offset <= window_radius; ++offset) {
    const double w = std::exp(-0.5 * static_cast<double>(offset * offset) / (window_sigma * window_sigma));
    const Eigen::Index count = image.rows() - std::abs(offset);
    if (count <= 0) continue;
    const Eigen::Index from = std::max<Eigen::Index>(offset, 0), to = std::max<Eigen::Index>(-offset, 0);
    sum.middleRows(to, count) += w * image.middleRows(from, count);
    weight.segment(to, count) += w;
  }
  return sum.colwise() / weight;
}

Eigen::ArrayXXd blurred(const Eigen::ArrayXXd& image) {
  const Eigen::ArrayXXd down = blurred_down(image);
  return blurred_down(down.transpose()).transpose();
}

// SSIM = (2 mu_a mu_b + C1)(2 s_ab + C2) / ((mu_a^2 + mu_b^2 + C1)(s_a^2 + s_b^2 + C2)), averaged over the image.
double structural_similarity(const Eigen::ArrayXXd& a, const Eigen::ArrayXXd& b) {
  const double c1 = std::pow(0.01 * 255.0, 2), c2 = std::pow(0.03 * 255.0, 2);
  const Eigen::ArrayXXd mean_a = blurred(a), mean_b = blurred(b);
  const Eigen::ArrayXXd variances = blurred(a.square() + b.square()) - mean_a.square() - mean_b.square();
  const Eigen::ArrayXXd covariance = blurred(a * b) - mean_a * mean_b;
  return ((2.0 * mean_a * mean_b + c1) * (2.0 * covariance + c2) /
          ((mean_a.square() + mean_b.square() + c1) * (variances + c2)))
      .mean();
}

}  // namespace

Comparison compare(const Image& a, const Image& b, int threshold) {
  require_same_size(a, b);
  const int channels = std::max(a.channels, b.channels);
  Comparison result;
  double sum = 0.0, squares = 0.0;
  std::size_t over = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      int largest = 0;
      for (int c = 0; c < channels; ++c) {
        const int d = std::abs(channel(a, x, y, c) - channel(b, x, y, c));
        largest = std::max(largest, d);
        sum += d;
        squares += double(d) * d;
      }
      result.max = std::max(result.max, largest);
      over += largest > threshold;
    }
  const double pixels = double(a.width) * a.height;
  result.mean = sum / (pixels * channels);
  result.rmse = std::sqrt(squares / (pixels * channels));
  result.psnr = result.rmse > 0.0 ? 20.0 * std::log10(255.0 / result.rmse) : std::numeric_limits<double>::infinity();
  result.ssim = structural_similarity(luma(a), luma(b));
  result.share_over = static_cast<double>(over) / pixels;
  return result;
}

bool within_tolerance(const Comparison& comparison) { return comparison.max <= 16 && comparison.share_over <= 0.01; }

Image difference(const Image& a, const Image& b, int gain) {
  require_same_size(a, b);
  Image result(a.width, a.height, 3);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const int d = gain * std::abs(channel(a, x, y, c) - channel(b, x, y, c));
        result.row(y)[3 * x + c] = static_cast<std::uint8_t>(std::min(d, 255));
      }
  return result;
}

}  // namespace billow::render
