// Which spatial frequencies of a velocity image move (the paper's Figure 5).
#pragma once

#include <Eigen/Core>

#include "base/words.h"
#include "render/image/image.h"

namespace billow::render {

/// What the velocities are multiplied by before the transform, which takes the image to go on at its opposite side.
/// Where the sides differ, that step alone puts power at every frequency along the axes: `none`, as in the paper, shows
/// it as a cross. `hann`, sin² across either way, fades the deviation from the mean out at the border, and blurs what
/// remains over 3 x 3 frequencies.
enum class Window { none, hann };
Words<Window> words(Window);

/// Power of a w x h image of velocities by spatial frequency: |F(k)|^2 / (w h)^2, summed over the three components,
/// where F is the discrete Fourier transform. Zero frequency is at row h / 2, column w / 2; frequencies are in cycles
/// per side. The powers sum to the mean square speed (Parseval).
struct Spectrum {
  Eigen::MatrixXd power;  // [m^2/s^2] (h x w)
};

/// `velocity` (w h x 3) [m/s], row by row. With a window the powers are divided by its mean square, so that they still
/// sum to the mean square speed of noise, and of other motion on average.
Spectrum spectrum_of(const Eigen::MatrixX3d& velocity, int width, int height, Window window = Window::none);

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
