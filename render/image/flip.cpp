// The paper's two pipelines, colour and feature, as separable filters over a window of rows.
#include "render/image/flip.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/srgb.h"

namespace billow::render {

namespace {

using std::numbers::pi;
using Rows = Eigen::ArrayXXd;  // a column for each row of the image
using Colour = Eigen::Array3d;

// ---- colours ----

const Eigen::Matrix3d& xyz_from_rgb() {  // linear sRGB, D65
  static const Eigen::Matrix3d matrix =
      (Eigen::Matrix3d() << 10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0,
       2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0, 1425312.0 / 73733382.0,
       8788810.0 / 73733382.0, 70074185.0 / 73733382.0)
          .finished();
  return matrix;
}

const Colour& white() {
  static const Colour xyz = (xyz_from_rgb() * Eigen::Vector3d::Ones()).array();
  return xyz;
}

double linear(std::uint8_t encoded) {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> values{};
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = srgb_to_linear(static_cast<double>(k) / 255.0);
    return values;
  }();
  return table[encoded];
}

// An opponent space that is linear in light: luma, red to green, blue to yellow.
Colour opponent(const Colour& rgb) {
  const Colour xyz = (xyz_from_rgb() * rgb.matrix()).array() / white();
  return {116.0 * xyz(1) - 16.0, 500.0 * (xyz(0) - xyz(1)), 200.0 * (xyz(1) - xyz(2))};
}

Colour rgb_of(const Colour& opponent) {
  static const Eigen::Matrix3d rgb_from_xyz = xyz_from_rgb().inverse();
  const double y = (opponent(0) + 16.0) / 116.0;
  const Colour xyz(y + opponent(1) / 500.0, y, y - opponent(2) / 200.0);
  return (rgb_from_xyz * (xyz * white()).matrix()).array();
}

// CIE L*a*b*, its colours paler in the dark, as Hunt found them.
Colour hunt_lab(const Colour& rgb) {
  constexpr double delta = 6.0 / 29.0;
  Colour f = (xyz_from_rgb() * rgb.matrix()).array() / white();
  for (double& t : f) t = t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
  const double lightness = 116.0 * f(1) - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (f(0) - f(1)), 0.01 * lightness * 200.0 * (f(1) - f(2))};
}

// A distance that holds for large differences too: city block in lightness, Euclid's in the colours.
double hyab(const Colour& a, const Colour& b) {
  const Colour d = a - b;
  return std::abs(d(0)) + std::hypot(d(1), d(2));
}

constexpr double colour_exponent = 0.7, knee = 0.4, knee_height = 0.95;

// Of a distance: in [0, 1], most of it for the differences that are common.
double colour_error(double distance) {
  static const double most = std::pow(hyab(hunt_lab({0.0, 1.0, 0.0}), hunt_lab({0.0, 0.0, 1.0})), colour_exponent);
  const double error = std::pow(distance, colour_exponent), bend = knee * most;
  if (error < bend) return error * knee_height / bend;
  return knee_height + (error - bend) / (most - bend) * (1.0 - knee_height);
}

// ---- filters ----

/// Weights of the pixels from -radius to radius.
using Kernel = std::vector<double>;

template <class Weight>
Kernel kernel(int radius, const Weight& weight) {
  Kernel weights;
  for (int x = -radius; x <= radius; ++x) weights.push_back(weight(x));
  return weights;
}

double sum(const Kernel& weights) {
  double total = 0.0;
  for (const double weight : weights) total += weight;
  return total;
}

// Those above zero come to 1, those below to -1.
void balance(Kernel& weights) {
  double above = 0.0, below = 0.0;
  for (const double weight : weights) (weight > 0.0 ? above : below) += std::abs(weight);
  for (double& weight : weights) weight /= weight > 0.0 ? above : below;
}

// The eye's sensitivity to contrast as a sum of Gaussians: amplitude a, spread b [degree^2] each.
struct Gaussian {
  double a, b;
};
constexpr Gaussian luma_sensitivity{1.0, 0.0047}, red_green_sensitivity{1.0, 0.0053};
constexpr std::array<Gaussian, 2> blue_yellow_sensitivity{{{34.1, 0.04}, {13.5, 0.025}}};

int sensitivity_radius(double pixels_per_degree) {
  const double widest = blue_yellow_sensitivity[0].b;
  return static_cast<int>(std::ceil(3.0 * std::sqrt(widest / (2.0 * pi * pi)) * pixels_per_degree));
}

Kernel sensitivity_kernel(const Gaussian& gaussian, double pixels_per_degree) {
  return kernel(sensitivity_radius(pixels_per_degree), [&](int x) {
    const double r = x / pixels_per_degree;
    return std::exp(-pi * pi * r * r / gaussian.b);
  });
}

Kernel normalized(Kernel weights) {
  const double total = sum(weights);
  for (double& weight : weights) weight /= total;
  return weights;
}

/// The kernels of both pipelines.
struct Kernels {
  explicit Kernels(double pixels_per_degree) {
    luma = normalized(sensitivity_kernel(luma_sensitivity, pixels_per_degree));
    red_green = normalized(sensitivity_kernel(red_green_sensitivity, pixels_per_degree));
    double whole = 0.0;
    for (std::size_t k = 0; k < 2; ++k) {
      const Gaussian& part = blue_yellow_sensitivity[k];
      const Kernel weights = sensitivity_kernel(part, pixels_per_degree);
      share[k] = part.a * std::sqrt(pi / part.b) * sum(weights) * sum(weights);
      whole += share[k];
      blue_yellow[k] = normalized(weights);
    }
    for (double& part : share) part /= whole;

    constexpr double feature_width = 0.082;  // [degree] of the finest edge that is seen
    const double sigma = 0.5 * feature_width * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    const auto gauss = [&](int x) { return std::exp(-x * x / (2.0 * sigma * sigma)); };
    smooth = normalized(kernel(radius, gauss));
    edge = kernel(radius, [&](int x) { return -x * gauss(x); });
    point = kernel(radius, [&](int x) { return (x * x / (sigma * sigma) - 1.0) * gauss(x); });
    balance(edge);
    balance(point);
  }

  Kernel luma, red_green, smooth, edge, point;
  std::array<Kernel, 2> blue_yellow;
  std::array<double, 2> share{};
};

int radius_of(const Kernel& weights) { return static_cast<int>(weights.size() / 2); }

// The border's pixels go on beyond it.
void filter_along(const Eigen::ArrayXd& line, const Kernel& weights, Eigen::Ref<Eigen::ArrayXd> filtered) {
  const Eigen::Index radius = radius_of(weights), width = line.size();
  Eigen::ArrayXd padded(width + 2 * radius);
  padded.head(radius).setConstant(line(0));
  padded.segment(radius, width) = line;
  padded.tail(radius).setConstant(line(width - 1));
  filtered.setZero();
  for (std::size_t k = 0; k < weights.size(); ++k)
    filtered += weights[k] * padded.segment(static_cast<Eigen::Index>(k), width);
}

/// One image: rows that are filtered along themselves and wait for those around them.
class FilteredRows {
 public:
  FilteredRows(Eigen::Index width, int radius, const Kernels& kernels)
      : kernels_(kernels), window_(2 * radius + 1), width_(width) {
    for (Rows& rows : waiting_) rows.resize(width, window_);
  }

  void add(Eigen::Index y, const std::uint8_t* row, int channels) {
    Rows colour(width_, 3);
    for (Eigen::Index x = 0; x < width_; ++x, row += channels) {
      const Colour rgb(linear(row[0]), linear(row[1]), linear(row[2]));
      colour.row(x) = opponent(rgb).transpose();
    }
    const Eigen::ArrayXd luma = (colour.col(0) + 16.0) / 116.0;
    const auto filter = [&](Plane plane, const Eigen::ArrayXd& line, const Kernel& weights) {
      filter_along(line, weights, waiting_[plane].col(y % window_));
    };
    filter(luma_plane, colour.col(0), kernels_.luma);
    filter(red_green_plane, colour.col(1), kernels_.red_green);
    filter(blue_yellow_plane, colour.col(2), kernels_.blue_yellow[0]);
    filter(blue_yellow_plane2, colour.col(2), kernels_.blue_yellow[1]);
    filter(smooth_plane, luma, kernels_.smooth);
    filter(edge_plane, luma, kernels_.edge);
    filter(point_plane, luma, kernels_.point);
  }

  /// What is seen of row `y` of `height`: opponent colours.
  Rows seen(Eigen::Index y, Eigen::Index height) const {
    Rows colour(width_, 3);
    colour.col(0) = across(luma_plane, kernels_.luma, y, height);
    colour.col(1) = across(red_green_plane, kernels_.red_green, y, height);
    colour.col(2) = kernels_.share[0] * across(blue_yellow_plane, kernels_.blue_yellow[0], y, height) +
                    kernels_.share[1] * across(blue_yellow_plane2, kernels_.blue_yellow[1], y, height);
    return colour;
  }

  Eigen::ArrayXd edges(Eigen::Index y, Eigen::Index height) const {
    return (across(edge_plane, kernels_.smooth, y, height).square() +
            across(smooth_plane, kernels_.edge, y, height).square())
        .sqrt();
  }

  Eigen::ArrayXd points(Eigen::Index y, Eigen::Index height) const {
    return (across(point_plane, kernels_.smooth, y, height).square() +
            across(smooth_plane, kernels_.point, y, height).square())
        .sqrt();
  }

 private:
  enum Plane {
    luma_plane,
    red_green_plane,
    blue_yellow_plane,
    blue_yellow_plane2,
    smooth_plane,
    edge_plane,
    point_plane,
    planes
  };

  Eigen::ArrayXd across(Plane plane, const Kernel& weights, Eigen::Index y, Eigen::Index height) const {
    const int radius = radius_of(weights);
    Eigen::ArrayXd filtered = Eigen::ArrayXd::Zero(width_);
    for (int offset = -radius; offset <= radius; ++offset) {
      const Eigen::Index row = std::clamp<Eigen::Index>(y + offset, 0, height - 1);
      filtered += weights[static_cast<std::size_t>(offset + radius)] * waiting_[plane].col(row % window_);
    }
    return filtered;
  }

  const Kernels& kernels_;
  Eigen::Index window_, width_;
  std::array<Rows, planes> waiting_;
};

Colour perceived(const Rows& colour, Eigen::Index x) {
  const Colour opponent = colour.row(x).transpose();
  return hunt_lab(rgb_of(opponent).max(0.0).min(1.0));
}

}  // namespace

struct Flip::Work {
  Work(int width, int height, Take take, double pixels_per_degree)
      : height(height),
        take(std::move(take)),
        kernels(pixels_per_degree),
        radius(std::max(radius_of(kernels.luma), radius_of(kernels.smooth))),
        reference(width, radius, kernels),
        test(width, radius, kernels) {}

  // The next row around which all rows are there that the image has.
  void judge() {
    const Rows seen_reference = reference.seen(judged, height), seen_test = test.seen(judged, height);
    const Eigen::ArrayXd features = (reference.edges(judged, height) - test.edges(judged, height))
                                        .abs()
                                        .max((reference.points(judged, height) - test.points(judged, height)).abs());
    Eigen::ArrayXd errors(features.size());
    for (Eigen::Index x = 0; x < errors.size(); ++x) {
      const double colour = colour_error(hyab(perceived(seen_reference, x), perceived(seen_test, x)));
      const double feature = std::sqrt(std::min(features(x) / std::numbers::sqrt2, 1.0));
      errors(x) = std::pow(colour, 1.0 - feature);
    }
    take(static_cast<int>(judged++), errors);
  }

  Eigen::Index height, added = 0, judged = 0;
  Take take;
  Kernels kernels;
  int radius;
  FilteredRows reference, test;
};

Flip::Flip(int width, int height, Take take, double pixels_per_degree)
    : work_(std::make_unique<Work>(width, height, std::move(take), pixels_per_degree)) {}

Flip::~Flip() = default;

void Flip::add_row(const std::uint8_t* reference, int reference_channels, const std::uint8_t* test, int test_channels) {
  work_->reference.add(work_->added, reference, reference_channels);
  work_->test.add(work_->added, test, test_channels);
  if (++work_->added > work_->radius) work_->judge();
}

void Flip::finish() {
  while (work_->judged < work_->added) work_->judge();
}

}  // namespace billow::render
