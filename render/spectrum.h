// Which spatial frequencies of a velocity image move (the paper's Figure 5).
#pragma once

#include <Eigen/Core>

#include "render/image.h"

namespace billow::render {

/// Power of a w x h image of velocities by spatial frequency: |F(k)|^2 / (w h)^2, summed over the three components,
/// where F is the discrete Fourier transform. Zero frequency is at row h / 2, column w / 2; frequencies are in cycles
/// per side. The powers sum to the mean square speed (Parseval). No window is applied.
struct Spectrum {
  Eigen::MatrixXd power;  // [m^2/s^2] (h x w)
};

/// `velocity` (w h x 3) [m/s], row by row.
Spectrum spectrum_of(const Eigen::MatrixX3d& velocity, int width, int height);

/// Power by radial frequency, rounded to whole cycles: entry r sums all frequencies at r - 1/2 to r + 1/2. Sums to the
/// mean square speed too.
Eigen::VectorXd radial_power(const Spectrum& spectrum);

/// The mean of many spectra: one moment's is noisy.
class SpectrumMean {
 public:
  void add(const Spectrum& spectrum);
  bool empty() const { return count_ == 0; }
  Spectrum mean() const { return {sum_ / static_cast<double>(count_)}; }

 private:
  Eigen::MatrixXd sum_;
  long count_ = 0;
};

/// Log power in grey, a pixel per frequency: white is the strongest, black what is `range` [dB] below it or less.
Image spectrum_picture(const Spectrum& spectrum, double range);

/// Velocities (w h x 3) as colours, a pixel per cell; `velocity_range` is the v_max [m/s].
Image velocity_picture(const Eigen::MatrixX3d& velocity, int width, int height, double velocity_range);

}  // namespace billow::render
