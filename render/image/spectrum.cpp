// Two-dimensional Fourier transform by rows, then columns.
#include "render/image/spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "render/image/colour_map.h"

namespace billow::render {

namespace {

using Complex = std::complex<double>;

Eigen::MatrixXcd transform(const Eigen::MatrixXd& image) {
  Eigen::FFT<double> fft;
  Eigen::MatrixXcd result = image.cast<Complex>();
  Eigen::VectorXcd line, transformed;
  for (Eigen::Index row = 0; row < result.rows(); ++row) {
    line = result.row(row).transpose();
    fft.fwd(transformed, line);
    result.row(row) = transformed.transpose();
  }
  for (Eigen::Index column = 0; column < result.cols(); ++column) {
    line = result.col(column);
    fft.fwd(transformed, line);
    result.col(column) = transformed;
  }
  return result;
}

// Frequency k of n stands at place (k + n / 2) mod n: zero in the middle, negative ones before it.
Eigen::MatrixXd centred(const Eigen::MatrixXd& power) {
  Eigen::MatrixXd moved(power.rows(), power.cols());
  for (Eigen::Index x = 0; x < power.cols(); ++x)
    for (Eigen::Index y = 0; y < power.rows(); ++y)
      moved((y + power.rows() / 2) % power.rows(), (x + power.cols() / 2) % power.cols()) = power(y, x);
  return moved;
}

// sin² over the n cells of a side, at their middles.
Eigen::VectorXd hann(int n) {
  const Eigen::ArrayXd middle = Eigen::ArrayXd::LinSpaced(n, 0.5, n - 0.5) / n;
  return (std::numbers::pi * middle).sin().square();
}

// The powers of an image. Under a window the mean is kept out of the blur: it would drown its neighbours.
Eigen::MatrixXd power_of(const Eigen::MatrixXd& image, Window window) {
  if (window == Window::none) return transform(image).cwiseAbs2();
  const Eigen::MatrixXd weight =
      hann(static_cast<int>(image.rows())) * hann(static_cast<int>(image.cols())).transpose();
  const Eigen::MatrixXd deviation = image.array() - image.mean();
  Eigen::MatrixXd power = transform(weight.cwiseProduct(deviation)).cwiseAbs2();
  power *= static_cast<double>(weight.size()) / weight.squaredNorm();
  power(0, 0) += std::pow(image.sum(), 2);
  return power;
}

}  // namespace

Words<Window> words(Window) {
  static constexpr Word<Window> list[] = {{"none", Window::none}, {"hann", Window::hann}};
  return list;
}

Spectrum spectrum_of(const Eigen::MatrixX3d& velocity, int width, int height, Window window) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::MatrixXd power = Eigen::MatrixXd::Zero(height, width);
  for (int axis = 0; axis < 3; ++axis)
    power += power_of(Eigen::Map<const RowMajor>(velocity.col(axis).data(), height, width), window);
  const double cells = static_cast<double>(width) * height;
  return {centred(power) / (cells * cells)};
}

Eigen::VectorXd radial_power(const Spectrum& spectrum) {
  const Eigen::Index column = spectrum.power.cols() / 2, row = spectrum.power.rows() / 2;  // of the middle
  const auto middle_x = static_cast<double>(column), middle_y = static_cast<double>(row);
  Eigen::VectorXd radial = Eigen::VectorXd::Zero(std::lround(std::hypot(middle_x, middle_y)) + 1);
  for (Eigen::Index x = 0; x < spectrum.power.cols(); ++x)
    for (Eigen::Index y = 0; y < spectrum.power.rows(); ++y)
      radial(std::lround(std::hypot(x - middle_x, y - middle_y))) += spectrum.power(y, x);
  return radial;
}

void SpectrumMean::add(const Spectrum& spectrum) {
  sum_ = count_ == 0 ? spectrum.power : (sum_ + spectrum.power).eval();
  ++count_;
}

Image spectrum_picture(const Spectrum& spectrum, double range) {
  Image image(static_cast<int>(spectrum.power.cols()), static_cast<int>(spectrum.power.rows()));
  const double strongest = spectrum.power.maxCoeff();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double decibel = strongest > 0.0 ? 10.0 * std::log10(spectrum.power(y, x) / strongest) : -range;
      const double grey = std::clamp(1.0 + decibel / range, 0.0, 1.0);
      std::fill_n(image.row(y) + 3 * x, 3, static_cast<std::uint8_t>(std::lround(255.0 * grey)));
    }
  return image;
}

Image velocity_picture(const Eigen::MatrixX3d& velocity, int width, int height, double velocity_range) {
  Image image(width, height);
  for (Eigen::Index cell = 0; cell < velocity.rows(); ++cell) {
    const Rgb8 colour = velocity_rgb(velocity.row(cell).transpose(), velocity_range);
    std::copy(colour.begin(), colour.end(), image.pixels.begin() + 3 * cell);
  }
  return image;
}

}  // namespace billow::render
