// Image metrics.
#include "render/image/compare.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <limits>
#include <stdexcept>

#include "base/error.h"
#include "render/image/flip.h"

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

/// SSIM = (2 mu_a mu_b + C1)(2 s_ab + C2) / ((mu_a^2 + mu_b^2 + C1)(s_a^2 + s_b^2 + C2)), averaged over the pixels that
/// count. The window is a product, so each row is blurred along itself once and waits until the rows around it have
/// come.
struct RowComparison::Similarity {
  Similarity(Eigen::Index width, Eigen::Index height)
      : width(width),
        height(height),
        inverse_weight(width),
        waiting(width, moments * rows),
        counts(width, rows),
        mean(width, moments) {
    for (Eigen::Index x = 0; x < width; ++x) inverse_weight(x) = 1.0 / weight_inside(x, width);
  }

  void add_row(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b, const Eigen::ArrayXd& count) {
    blur_along(a, waiting.col(column(0, added)));
    blur_along(b, waiting.col(column(1, added)));
    blur_along(a.square() + b.square(), waiting.col(column(2, added)));
    blur_along(a * b, waiting.col(column(3, added)));
    counts.col(added % rows) = count;
    if (++added > window_radius) judge();
  }

  double finish(std::int64_t pixels) {
    while (judged < height) judge();
    return sum / static_cast<double>(pixels);
  }

 private:
  static constexpr Eigen::Index moments = 4;  // of a pair of pixels: a, b, a^2 + b^2, a b
  static constexpr Eigen::Index rows = 2 * window_radius + 1;
  static constexpr Eigen::Index block = 512;  // [pixel] what the processor's first cache holds of all rows

  static Eigen::Index column(Eigen::Index moment, Eigen::Index row) { return moment * rows + row % rows; }

  template <class Values, class Blurred>
  void blur_along(const Values& values, Blurred&& blurred) const {
    const Eigen::ArrayXd line = values;
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
    for (Eigen::Index begin = 0; begin < width; begin += block) {
      const Eigen::Index count = std::min(block, width - begin);
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
    const Eigen::ArrayXd similarity =
        (2.0 * product + c1) * (2.0 * (of(3) - product) + c2) / ((squares + c1) * (of(2) - squares + c2));
    sum += (similarity * counts.col(judged % rows).segment(begin, count)).sum();
  }

  Eigen::Index width, height, added = 0, judged = 0;
  Eigen::ArrayXd inverse_weight;
  Eigen::ArrayXXd waiting, counts, mean;
  double sum = 0.0;
};

/// Which differing pixels lie at an edge that both images have: where a channel spans more around one than it does on a
/// surface in both, a silhouette that is a fraction of a pixel aside explains the difference.
struct RowComparison::Edges {
  static constexpr int least_edge = 24;  // [1/255]
  static constexpr Eigen::Index rows = 3;

  Edges(int width, int a_channels, int b_channels) : width(width), a(a_channels), b(b_channels), differs(width, rows) {}

  void add_row(const std::uint8_t* row_a, const std::uint8_t* row_b, const Eigen::ArrayXd& over) {
    a.set(added, row_a, width);
    b.set(added, row_b, width);
    differs.col(added % rows) = over;
    if (++added > 1) judge(added - 2, added);
  }

  std::int64_t finish() {
    judge(added - 1, added);
    return off_edges;
  }

 private:
  /// The last rows of an image.
  struct Window {
    explicit Window(int channels) : channels(channels) {}

    void set(Eigen::Index row, const std::uint8_t* pixels, Eigen::Index width) {
      row_at(row).assign(pixels, pixels + width * channels);
    }

    // Of the channel that has most, among the pixels around one, of the rows before `end`.
    int span(Eigen::Index x, Eigen::Index row, Eigen::Index end, Eigen::Index width) {
      int most = 0;
      for (int c = 0; c < 3; ++c) {
        int low = 255, high = 0;
        for (Eigen::Index v = std::max<Eigen::Index>(row - 1, 0); v < std::min(row + 2, end); ++v)
          for (Eigen::Index u = std::max<Eigen::Index>(x - 1, 0); u < std::min(x + 2, width); ++u) {
            const int value = row_at(v)[static_cast<std::size_t>(u * channels + c)];
            low = std::min(low, value);
            high = std::max(high, value);
          }
        most = std::max(most, high - low);
      }
      return most;
    }

    std::vector<std::uint8_t>& row_at(Eigen::Index row) { return held[static_cast<std::size_t>(row % rows)]; }

    int channels;
    std::array<std::vector<std::uint8_t>, rows> held;
  };

  // A row, of the rows before `end`.
  void judge(Eigen::Index row, Eigen::Index end) {
    for (Eigen::Index x = 0; x < width; ++x)
      if (differs(x, row % rows) != 0.0 &&
          (a.span(x, row, end, width) <= least_edge || b.span(x, row, end, width) <= least_edge))
        ++off_edges;
  }

  Eigen::Index width;
  Window a, b;
  Eigen::ArrayXXd differs;
  Eigen::Index added = 0;
  std::int64_t off_edges = 0;
};

/// ꟻLIP's errors, summed over the pixels that count; a row's come when those below it are there.
struct RowComparison::Flips {
  Flips(int width, int height)
      : flip(width, height, [this](int, const Eigen::ArrayXd& errors) {
          sum += (errors * waiting.front()).sum();
          waiting.pop_front();
        }) {}

  std::deque<Eigen::ArrayXd> waiting;
  double sum = 0.0;
  Flip flip;
};

RowComparison::RowComparison(const Shape& a, const Shape& b, const ComparisonOptions& options)
    : width_(a.width),
      a_channels_(a.channels),
      b_channels_(b.channels),
      channels_(options.ignore_alpha ? 3 : std::max(a.channels, b.channels)),
      threshold_(options.threshold) {
  if (a.width != b.width || a.height != b.height)
    throw InputError(
        fmt::format("the images differ in size: {} x {} and {} x {}", a.width, a.height, b.width, b.height));
  if (a.width <= 0 || a.height <= 0) throw InputError("the images have no pixels");
  similarity_ = std::make_unique<Similarity>(a.width, a.height);
  edges_ = std::make_unique<Edges>(a.width, a.channels, b.channels);
  if (options.flip) flips_ = std::make_unique<Flips>(a.width, a.height);
}

RowComparison::~RowComparison() = default;

void RowComparison::add_row(const std::uint8_t* a, const std::uint8_t* b, const std::uint8_t* counts) {
  Eigen::ArrayXd luma_a(width_), luma_b(width_), counted(width_), over(width_);
  luma(a, a_channels_, luma_a);
  luma(b, b_channels_, luma_b);
  const std::uint8_t *row_a = a, *row_b = b;
  std::int64_t sum = 0, squares = 0;
  for (int x = 0; x < width_; ++x, a += a_channels_, b += b_channels_) {
    counted(x) = !counts || counts[x] != 0 ? 1.0 : 0.0;
    over(x) = 0.0;
    if (counted(x) == 0.0) continue;
    int largest = 0;
    for (int c = 0; c < channels_; ++c) {
      const int d = std::abs(channel(a, a_channels_, c) - channel(b, b_channels_, c));
      largest = std::max(largest, d);
      sum += d;
      squares += d * d;
    }
    if (largest > result_.max) result_.max = largest, result_.worst_x = x, result_.worst_y = static_cast<int>(rows_);
    over(x) = largest > threshold_ ? 1.0 : 0.0;
    result_.over += largest > threshold_;
    ++result_.pixels;
  }
  sum_ += static_cast<double>(sum);
  squares_ += static_cast<double>(squares);
  similarity_->add_row(luma_a, luma_b, counted);
  edges_->add_row(row_a, row_b, over);
  if (flips_) {
    flips_->waiting.push_back(counted);
    flips_->flip.add_row(row_a, a_channels_, row_b, b_channels_);
  }
  ++rows_;
}

Comparison RowComparison::finish() {
  if (result_.pixels == 0) throw InputError("no pixel counts: the mask is black everywhere; make white what counts");
  const double values = static_cast<double>(result_.pixels) * channels_;
  result_.mean = sum_ / values;
  result_.rmse = std::sqrt(squares_ / values);
  result_.psnr = result_.rmse > 0.0 ? 20.0 * std::log10(255.0 / result_.rmse) : std::numeric_limits<double>::infinity();
  result_.ssim = similarity_->finish(result_.pixels);
  result_.over_off_edges = edges_->finish();
  if (flips_) {
    flips_->flip.finish();
    result_.flip = flips_->sum / static_cast<double>(result_.pixels);
  }
  result_.share_over = static_cast<double>(result_.over) / static_cast<double>(result_.pixels);
  return result_;
}

Comparison compare(const Image& a, const Image& b, const ComparisonOptions& options) {
  RowComparison comparison({a.width, a.height, a.channels}, {b.width, b.height, b.channels}, options);
  for (int y = 0; y < a.height; ++y) comparison.add_row(a.row(y), b.row(y));
  return comparison.finish();
}

Words<Metric> words(Metric) {
  static constexpr Word<Metric> list[] = {{"max", Metric::max},
                                          {"rmse", Metric::rmse},
                                          {"psnr", Metric::psnr},
                                          {"ssim", Metric::ssim},
                                          {"flip", Metric::flip}};
  return list;
}

double largest(Metric metric) {
  switch (metric) {
    case Metric::max:
    case Metric::rmse:
      return 255.0;
    case Metric::psnr:
      return 1000.0;
    case Metric::ssim:
    case Metric::flip:
      return 1.0;
  }
  throw std::logic_error("a metric has no largest value");
}

namespace {

bool holds(const Comparison& c, const MetricLimit& m) {
  switch (m.metric) {
    case Metric::max:
      return c.max <= m.limit;
    case Metric::rmse:
      return c.rmse <= m.limit;
    case Metric::psnr:
      return c.psnr >= m.limit;
    case Metric::ssim:
      return c.ssim >= m.limit;
    case Metric::flip:
      return c.flip.value() <= m.limit;
  }
  throw std::logic_error("a metric has no rule");
}

}  // namespace

bool within_tolerance(const Comparison& comparison, const Tolerance& tolerance) {
  if (!tolerance.metrics.empty())
    return std::all_of(tolerance.metrics.begin(), tolerance.metrics.end(),
                       [&](const MetricLimit& limit) { return holds(comparison, limit); });
  const bool few = tolerance.pixels ? comparison.over <= *tolerance.pixels : comparison.share_over <= tolerance.share;
  return comparison.max <= tolerance.worst && few;
}

std::string difference_text(const Comparison& c, int threshold) {
  if (c.max == 0) return "equal";
  const std::string worst = fmt::format("worst {} at ({}, {})", c.max, c.worst_x, c.worst_y);
  if (c.over == 0) return fmt::format("no pixel over {}/255, {}", threshold, worst);
  const std::string where = c.over_off_edges == 0        ? "all within 1 px of an edge"
                            : c.over_off_edges == c.over ? "none at an edge"
                                                         : fmt::format("{} off any edge", c.over_off_edges);
  const double percent = 100.0 * c.share_over;
  return fmt::format("{} px over {}/255 ({:.{}g} %), {}, {}", c.over, threshold, percent, percent < 10.0 ? 2 : 3, worst,
                     where);
}

void difference_row(const std::uint8_t* a, int a_channels, const std::uint8_t* b, int b_channels, int width,
                    std::uint8_t* row) {
  constexpr int gain = 8;
  for (int x = 0; x < width; ++x)
    for (int c = 0; c < 3; ++c)
      row[3 * x + c] =
          static_cast<std::uint8_t>(std::min(gain * std::abs(a[x * a_channels + c] - b[x * b_channels + c]), 255));
}

}  // namespace billow::render
