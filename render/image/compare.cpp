// Differences of rows of values; what is seen of them goes to Similarity and Flip.
#include "render/image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <limits>
#include <stdexcept>

#include "base/error.h"
#include "render/image/flip.h"

namespace billow::render {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool same_value(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

// What of 255 a difference of two values is, which lie around `a` and `b`.
double share_of_white(Depth depth, const RowChannel& channel, double difference, double a, double b) {
  if (!std::isfinite(difference)) return infinity;
  if (channel.exact()) return difference == 0.0 ? 0.0 : 255.0;
  if (depth != Depth::floats) return difference * 255.0 / white_of(depth);
  return 255.0 * difference / std::max({1.0, std::abs(a), std::abs(b)});
}

// Without those of infinities of one sign, which have none.
double difference_of(double a, double b) { return same_value(a, b) ? 0.0 : std::abs(a - b); }

/// The values around a pixel.
struct Surroundings {
  double low = infinity, high = -infinity;
  bool has_nan = false, has_it = false;  // the value that is looked for

  void add(double value, double wanted) {
    if (std::isnan(value)) {
      has_nan = true;
      return;
    }
    has_it = has_it || value == wanted;
    low = std::min(low, value);
    high = std::max(high, value);
  }

  // By how much a value is beyond them.
  double beyond(double value, bool exact) const {
    if (std::isnan(value)) return has_nan ? 0.0 : infinity;
    if (has_it || (!exact && value >= low && value <= high)) return 0.0;
    return exact || !(low <= high) ? infinity : std::min(std::abs(value - low), std::abs(value - high));
  }
};

/// The last rows of an image.
class RowWindow {
 public:
  explicit RowWindow(int radius) : rows_(2 * radius + 1), held_(static_cast<std::size_t>(rows_)) {}

  void add(const ValueRow& row) { held_[static_cast<std::size_t>(added_++ % rows_)] = row; }
  const ValueRow& at(Eigen::Index row) const { return held_[static_cast<std::size_t>(row % rows_)]; }
  Eigen::Index added() const { return added_; }

  // Within `radius` of a pixel, of the rows that have been added.
  Surroundings around(Eigen::Index x, Eigen::Index y, Eigen::Index c, int radius, double wanted) const {
    Surroundings found;
    for (Eigen::Index v = std::max<Eigen::Index>(y - radius, 0); v < std::min(y + radius + 1, added_); ++v) {
      const ValueRow& row = at(v);
      for (Eigen::Index u = std::max<Eigen::Index>(x - radius, 0); u < std::min(x + radius + 1, row.rows()); ++u)
        found.add(row(u, c), wanted);
    }
    return found;
  }

 private:
  Eigen::Index rows_, added_ = 0;
  std::vector<ValueRow> held_;
};

RowShape shape_of_pixels(const RowComparison::Shape& a, const RowComparison::Shape& b) {
  if (a.width != b.width || a.height != b.height)
    throw InputError(
        fmt::format("the images differ in size: {} x {} and {} x {}", a.width, a.height, b.width, b.height));
  RowShape shape{a.width, a.height, 0, 0, Depth::bits8, {{"R"}, {"G"}, {"B"}}};
  if (std::max(a.channels, b.channels) > 3) shape.channels.push_back({"A"});
  return shape;
}

ValueRow values_of(const std::uint8_t* row, int channels, const RowShape& shape) {
  ValueRow values(shape.width, static_cast<Eigen::Index>(shape.channels.size()));
  for (Eigen::Index x = 0; x < values.rows(); ++x, row += channels)
    for (Eigen::Index c = 0; c < values.cols(); ++c) values(x, c) = c < channels ? row[c] : 255;
  return values;
}

// Rec. 709 weights on the encoded values, as image metrics do.
Eigen::ArrayXd luma_of(const std::vector<std::uint8_t>& seen) {
  Eigen::ArrayXd luma(static_cast<Eigen::Index>(seen.size() / 3));
  const std::uint8_t* rgb = seen.data();
  for (Eigen::Index x = 0; x < luma.size(); ++x, rgb += 3)
    luma(x) = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  return luma;
}

}  // namespace

/// How far the values of rows are apart, judged as soon as the rows around one have come.
struct RowComparison::Differences {
  Differences(const RowShape& shape, const ComparisonOptions& options)
      : shape(shape),
        options(options),
        radius(std::max(options.edge, 1)),
        of_255(255.0 / white_of(shape.depth)),
        a(radius),
        b(radius),
        counted(shape.width, 2 * radius + 1),
        over(static_cast<std::size_t>(shape.width)),
        worst(static_cast<std::size_t>(shape.width)) {
    result.depth = shape.depth;
    std::vector<std::string> names;  // of layers
    for (const RowChannel& channel : shape.channels) {
      result.channels.push_back({channel.name});
      const auto known = std::find(names.begin(), names.end(), layer_of(channel.name));
      layer.push_back(static_cast<int>(known - names.begin()));
      if (known == names.end()) names.push_back(layer_of(channel.name));
    }
    over_in.resize(shape.width, static_cast<Eigen::Index>(shape.channels.size()));
  }

  void add_row(const ValueRow& row_a, const ValueRow& row_b, const Eigen::ArrayXd& counts) {
    counted.col(a.added() % counted.cols()) = counts;
    a.add(row_a);
    b.add(row_b);
    if (a.added() > radius) judge();
  }

  Comparison finish(std::int64_t pixels) {
    while (judged < a.added()) judge();
    const double unit = white_of(shape.depth) / (shape.depth == Depth::floats ? 1.0 : 255.0);
    const double values = std::max<double>(static_cast<double>(compared - result.not_finite), 1.0);
    result.pixels = pixels;
    result.mean = sum / values / unit;
    result.rmse = std::sqrt(squares / values) / unit;
    const double white = white_of(shape.depth) / unit;
    result.psnr = result.rmse > 0.0 ? 20.0 * std::log10(white / result.rmse) : infinity;
    result.share_over = static_cast<double>(result.over) / static_cast<double>(pixels);
    for (ChannelComparison& channel : result.channels) {
      channel.max /= unit;
      result.max = std::max(result.max, channel.max);
    }
    return result;
  }

 private:
  void judge() {
    const auto counts = counted.col(judged % counted.cols());
    std::fill(over.begin(), over.end(), State::near);
    std::fill(worst.begin(), worst.end(), 0.0);
    over_in.setConstant(false);
    for (Eigen::Index c = 0; c < static_cast<Eigen::Index>(shape.channels.size()); ++c) {
      if (options.ignore_alpha && shape.channels[c].name == "A") continue;
      for (Eigen::Index x = 0; x < shape.width; ++x)
        if (counts(x) != 0.0) judge_value(x, c);
    }
    for (Eigen::Index x = 0; x < shape.width; ++x) {
      result.explained += over[x] == State::explained;
      if (over[x] != State::over) continue;
      ++result.over;
      result.over_off_edges += is_off_edges(x);
    }
    find_worst();
    ++judged;
  }

  void judge_value(Eigen::Index x, Eigen::Index c) {
    const double value_a = a.at(judged)(x, c), value_b = b.at(judged)(x, c);
    ++compared;
    if (same_value(value_a, value_b)) {
      result.both_nan += std::isnan(value_a);
      return;
    }
    const double plain = shape.channels[c].exact() ? 1.0 : difference_of(value_a, value_b);
    const double difference = options.edge > 0 ? std::min(plain_or_infinite(plain), unexplained(x, c, value_a, value_b))
                                               : plain_or_infinite(plain);
    const auto share = [&](double of) {
      return shape.depth != Depth::floats ? of * of_255
                                          : share_of_white(shape.depth, shape.channels[c], of, value_a, value_b);
    };
    const double apart = share(difference);
    ChannelComparison& channel = result.channels[c];
    if (std::isfinite(difference)) {
      channel.max = std::max(channel.max, difference);
      sum += difference;
      squares += difference * difference;
    } else {
      ++result.not_finite;
    }
    if (apart > options.threshold)
      ++channel.over, over[x] = State::over, over_in(x, c) = true;
    else if (options.edge > 0 && over[x] == State::near && share(plain_or_infinite(plain)) > options.threshold)
      over[x] = State::explained;
    worst[x] = std::max(worst[x], apart);
  }

  static double plain_or_infinite(double difference) { return std::isnan(difference) ? infinity : difference; }

  // What of a difference neither image has within the reach of edges.
  double unexplained(Eigen::Index x, Eigen::Index c, double value_a, double value_b) const {
    const bool exact = shape.channels[c].exact();
    return std::max(b.around(x, judged, c, options.edge, value_a).beyond(value_a, exact),
                    a.around(x, judged, c, options.edge, value_b).beyond(value_b, exact));
  }

  // Whether a layer that differs has no edge there in one of the images. That of another explains nothing: a colour's
  // texture ends where no velocity does.
  bool is_off_edges(Eigen::Index x) const {
    int looked_at = -1;  // a layer's channels mostly follow one another
    for (Eigen::Index c = 0; c < over_in.cols(); ++c) {
      if (!over_in(x, c) || layer[c] == looked_at) continue;
      looked_at = layer[c];
      if (!has_edge(a, x, looked_at) || !has_edge(b, x, looked_at)) return true;
    }
    return false;
  }

  // Whether a channel of the layer spans more around a pixel than it does on a surface: where both images have an edge,
  // a silhouette that is a fraction of a pixel aside explains a difference.
  bool has_edge(const RowWindow& image, Eigen::Index x, int of) const {
    constexpr double least_edge = 24.0;  // [1/255]
    for (Eigen::Index c = 0; c < over_in.cols(); ++c) {
      if (layer[c] != of) continue;
      const Surroundings found = image.around(x, judged, c, 1, 0.0);
      if (!(found.low <= found.high)) continue;
      const double span = found.low == found.high ? 0.0 : found.high - found.low;
      if (share_of_white(shape.depth, shape.channels[c], span, found.low, found.high) > least_edge) return true;
    }
    return false;
  }

  void find_worst() {
    const auto most = std::max_element(worst.begin(), worst.end());
    if (*most <= result.apart) return;
    result.apart = *most;
    result.worst_x = static_cast<int>(most - worst.begin());
    result.worst_y = static_cast<int>(judged);
    double furthest = -1.0;
    for (Eigen::Index c = 0; c < static_cast<Eigen::Index>(shape.channels.size()); ++c) {
      if (options.ignore_alpha && shape.channels[c].name == "A") continue;
      const double value_a = a.at(judged)(result.worst_x, c), value_b = b.at(judged)(result.worst_x, c);
      const double difference = plain_or_infinite(difference_of(value_a, value_b));
      const double apart = share_of_white(shape.depth, shape.channels[c], difference, value_a, value_b);
      if (apart <= furthest) continue;
      furthest = apart;
      result.worst_channel = shape.channels[c].name;
      result.worst_meaning = shape.channels[c].meaning;
      result.worst_a = value_a;
      result.worst_b = value_b;
    }
  }

  enum class State { near, explained, over };

  const RowShape& shape;
  ComparisonOptions options;
  int radius;
  double of_255;  // what a step of the values is
  RowWindow a, b;
  Eigen::ArrayXXd counted;
  std::vector<int> layer;                                      // of each channel, from 0
  std::vector<State> over;                                     // of the pixels of a row
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> over_in;  // (width x channels)
  std::vector<double> worst;                                   // [1/255]
  Eigen::Index judged = 0;
  std::int64_t compared = 0;
  double sum = 0.0, squares = 0.0;
  Comparison result;
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

RowComparison::RowComparison(const RowShape& shape, const ComparisonOptions& options) : shape_(shape) {
  if (shape.width <= 0 || shape.height <= 0) throw InputError("the images have no pixels");
  differences_ = std::make_unique<Differences>(shape_, options);
  if (shape.colours()) similarity_ = std::make_unique<Similarity>(shape.width, shape.height);
  if (options.flip && similarity_) flips_ = std::make_unique<Flips>(shape.width, shape.height);
}

RowComparison::RowComparison(const Shape& a, const Shape& b, const ComparisonOptions& options)
    : RowComparison(shape_of_pixels(a, b), options) {
  a_channels_ = a.channels;
  b_channels_ = b.channels;
}

RowComparison::~RowComparison() = default;

void RowComparison::add_row(const std::uint8_t* a, const std::uint8_t* b, const std::uint8_t* counts) {
  add_row(values_of(a, a_channels_, shape_), values_of(b, b_channels_, shape_), counts);
}

void RowComparison::add_row(const ValueRow& a, const ValueRow& b, const std::uint8_t* counts) {
  Eigen::ArrayXd counted = Eigen::ArrayXd::Ones(shape_.width);
  if (counts)
    for (Eigen::Index x = 0; x < counted.size(); ++x) counted(x) = counts[x] != 0 ? 1.0 : 0.0;
  pixels_ += static_cast<std::int64_t>(counted.sum());
  differences_->add_row(a, b, counted);
  if (similarity_) add_seen(a, b, counted);
}

void RowComparison::add_seen(const ValueRow& a, const ValueRow& b, const Eigen::ArrayXd& counted) {
  const std::vector<std::uint8_t> seen_a = seen_row(shape_, a), seen_b = seen_row(shape_, b);
  similarity_->add_row(luma_of(seen_a), luma_of(seen_b), counted);
  if (!flips_) return;
  flips_->waiting.push_back(counted);
  flips_->flip.add_row(seen_a.data(), 3, seen_b.data(), 3);
}

Comparison RowComparison::finish() {
  if (pixels_ == 0) throw InputError("no pixel counts: the mask is black everywhere; make white what counts");
  Comparison result = differences_->finish(pixels_);
  result.ssim = similarity_ ? similarity_->finish(pixels_) : std::numeric_limits<double>::quiet_NaN();
  if (flips_) {
    flips_->flip.finish();
    result.flip = flips_->sum / static_cast<double>(pixels_);
  }
  return result;
}

Comparison compare(const Image& a, const Image& b, const ComparisonOptions& options) {
  RowComparison comparison({a.width, a.height, a.channels}, {b.width, b.height, b.channels}, options);
  for (int y = 0; y < a.height; ++y) comparison.add_row(a.row(y), b.row(y));
  return comparison.finish();
}

namespace {

constexpr double difference_gain = 8.0;

std::uint8_t gained(double of_255) {
  return static_cast<std::uint8_t>(std::min(std::lround(std::min(difference_gain * of_255, 255.0)), 255L));
}

}  // namespace

void difference_row(const std::uint8_t* a, int a_channels, const std::uint8_t* b, int b_channels, int width,
                    std::uint8_t* row) {
  for (int x = 0; x < width; ++x)
    for (int c = 0; c < 3; ++c) row[3 * x + c] = gained(std::abs(a[x * a_channels + c] - b[x * b_channels + c]));
}

void difference_row(const RowShape& shape, const ValueRow& a, const ValueRow& b, std::uint8_t* row) {
  for (Eigen::Index x = 0; x < a.rows(); ++x) {
    const auto apart = [&](Eigen::Index c) {
      const double difference = difference_of(a(x, c), b(x, c));
      return share_of_white(shape.depth, shape.channels[c], difference, a(x, c), b(x, c));
    };
    double furthest = 0.0;
    for (Eigen::Index c = 0; c < a.cols(); ++c) furthest = std::max(furthest, apart(c));
    for (Eigen::Index c = 0; c < 3; ++c) row[3 * x + c] = gained(shape.depth == Depth::floats ? furthest : apart(c));
  }
}

}  // namespace billow::render
