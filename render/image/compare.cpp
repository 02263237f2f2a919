// Image metrics.
#include "render/image/compare.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/error.h"

namespace billow::render {
namespace {

constexpr int window_radius = 5;      // an 11 x 11 window
constexpr double window_sigma = 1.5;  // [pixel]

double window_weight(int offset) { return std::exp(-0.5 * offset * offset / (window_sigma * window_sigma)); }

// The weights of those pixels of a window around `centre` that lie within `size` pixels, summed.
double weight_inside(Eigen::Index centre, Eigen::Index size) {
  double sum = 0.0;
  for (int offset = -window_radius; offset <= window_radius; ++offset)
    if (centre + offset >= 0 && centre + offset < size) sum += window_weight(offset);
  return sum;
}

int channel(const std::uint8_t* pixel, int channels, int c) { return c < channels ? pixel[c] : 255; }

// Rec. 709 weights on the encoded values, as image metrics do.
void luma(const std::uint8_t* row, int channels, Eigen::ArrayXd& result) {
  for (Eigen::Index x = 0; x < result.size(); ++x, row += channels)
    result(x) = 0.2126 * row[0] + 0.7152 * row[1] + 0.0722 * row[2];
}

}  // namespace

/// SSIM = (2 mu_a mu_b + C1)(2 s_ab + C2) / ((mu_a^2 + mu_b^2 + C1)(s_a^2 + s_b^2 + C2)), averaged over the image. The
/// window is a product, so each row is blurred along itself once and waits until the rows around it have come.
struct RowComparison::Similarity {
  Similarity(Eigen::Index width, Eigen::Index height)
      : height(height),
        a(width),
        b(width),
        inverse_weight(width),
        waiting(width, moments * rows),
        mean(width, moments) {
    for (Eigen::Index x = 0; x < width; ++x) inverse_weight(x) = 1.0 / weight_inside(x, width);
  }

  void add_row(const std::uint8_t* row_a, int channels_a, const std::uint8_t* row_b, int channels_b) {
    luma(row_a, channels_a, a);
    luma(row_b, channels_b, b);
    blur_along(a, waiting.col(column(0, added)));
    blur_along(b, waiting.col(column(1, added)));
    blur_along(a.square() + b.square(), waiting.col(column(2, added)));
    blur_along(a * b, waiting.col(column(3, added)));
    if (++added > window_radius) judge();
  }

  double finish() {
    while (judged < height) judge();
    return sum / (static_cast<double>(height) * static_cast<double>(a.size()));
  }

 private:
  static constexpr Eigen::Index moments = 4;  // of a pair of pixels: a, b, a^2 + b^2, a b
  static constexpr Eigen::Index rows = 2 * window_radius + 1;
  static constexpr Eigen::Index block = 512;  // [pixel] what the processor's first cache holds of all rows

  static Eigen::Index column(Eigen::Index moment, Eigen::Index row) { return moment * rows + row % rows; }

  template <class Values, class Blurred>
  void blur_along(const Values& values, Blurred&& blurred) const {
    const Eigen::ArrayXd line = values;
    const Eigen::Index width = line.size();
    blurred.setZero();
    for (Eigen::Index begin = 0; begin < width; begin += block)
      for (int offset = -window_radius; offset <= window_radius; ++offset) {
        const Eigen::Index from = std::max<Eigen::Index>(begin, -offset);
        const Eigen::Index to = std::min(std::min(begin + block, width), width - offset);
        if (to > from)
          blurred.segment(from, to - from) += window_weight(offset) * line.segment(from + offset, to - from);
      }
    blurred *= inverse_weight;
  }

  // The next row around which all rows are there that the image has.
  void judge() {
    const double scale = 1.0 / weight_inside(judged, height);
    for (Eigen::Index begin = 0; begin < a.size(); begin += block) {
      const Eigen::Index count = std::min(block, a.size() - begin);
      for (Eigen::Index moment = 0; moment < moments; ++moment) {
        auto blurred = mean.col(moment).segment(begin, count);
        blurred.setZero();
        for (int offset = -window_radius; offset <= window_radius; ++offset)
          if (const Eigen::Index row = judged + offset; row >= 0 && row < height)
            blurred += scale * window_weight(offset) * waiting.col(column(moment, row)).segment(begin, count);
      }
      add_similarity(begin, count);
    }
    ++judged;
  }

  void add_similarity(Eigen::Index begin, Eigen::Index count) {
    constexpr double c1 = (0.01 * 255.0) * (0.01 * 255.0), c2 = (0.03 * 255.0) * (0.03 * 255.0);
    const auto of = [&](Eigen::Index moment) { return mean.col(moment).segment(begin, count); };
    const Eigen::ArrayXd product = of(0) * of(1), squares = of(0).square() + of(1).square();
    sum += ((2.0 * product + c1) * (2.0 * (of(3) - product) + c2) / ((squares + c1) * (of(2) - squares + c2))).sum();
  }

  Eigen::Index height, added = 0, judged = 0;
  Eigen::ArrayXd a, b, inverse_weight;
  Eigen::ArrayXXd waiting, mean;
  double sum = 0.0;
};

RowComparison::RowComparison(const Shape& a, const Shape& b, int threshold) : a_(a), b_(b), threshold_(threshold) {
  if (a.width != b.width || a.height != b.height)
    throw InputError(
        fmt::format("the images differ in size: {} x {} and {} x {}", a.width, a.height, b.width, b.height));
  if (a.width <= 0 || a.height <= 0) throw InputError("the images have no pixels");
  similarity_ = std::make_unique<Similarity>(a.width, a.height);
}

RowComparison::~RowComparison() = default;

void RowComparison::add_row(const std::uint8_t* a, const std::uint8_t* b) {
  similarity_->add_row(a, a_.channels, b, b_.channels);
  const int channels = std::max(a_.channels, b_.channels);
  long sum = 0, squares = 0;
  for (int x = 0; x < a_.width; ++x, a += a_.channels, b += b_.channels) {
    int largest = 0;
    for (int c = 0; c < channels; ++c) {
      const int d = std::abs(channel(a, a_.channels, c) - channel(b, b_.channels, c));
      largest = std::max(largest, d);
      sum += d;
      squares += d * d;
    }
    max_ = std::max(max_, largest);
    over_ += largest > threshold_;
  }
  sum_ += static_cast<double>(sum);
  squares_ += static_cast<double>(squares);
}

Comparison RowComparison::finish() {
  const double pixels = double(a_.width) * a_.height, values = pixels * std::max(a_.channels, b_.channels);
  Comparison result;
  result.max = max_;
  result.mean = sum_ / values;
  result.rmse = std::sqrt(squares_ / values);
  result.psnr = result.rmse > 0.0 ? 20.0 * std::log10(255.0 / result.rmse) : std::numeric_limits<double>::infinity();
  result.ssim = similarity_->finish();
  result.share_over = static_cast<double>(over_) / pixels;
  return result;
}

Comparison compare(const Image& a, const Image& b, int threshold) {
  RowComparison comparison({a.width, a.height, a.channels}, {b.width, b.height, b.channels}, threshold);
  for (int y = 0; y < a.height; ++y) comparison.add_row(a.row(y), b.row(y));
  return comparison.finish();
}

bool within_tolerance(const Comparison& comparison) { return comparison.max <= 16 && comparison.share_over <= 0.01; }

void difference_row(const std::uint8_t* a, int a_channels, const std::uint8_t* b, int b_channels, int width,
                    std::uint8_t* row) {
  constexpr int gain = 8;
  for (int x = 0; x < width; ++x)
    for (int c = 0; c < 3; ++c)
      row[3 * x + c] =
          static_cast<std::uint8_t>(std::min(gain * std::abs(a[x * a_channels + c] - b[x * b_channels + c]), 255));
}

}  // namespace billow::render
