// How far apart two images are.
#pragma once

#include <cstdint>
#include <memory>

#include "render/image/image.h"

namespace billow::render {

/// Differences are between 8-bit channel values; images without alpha count as opaque.
struct Comparison {
  int max = 0;              // largest difference of a channel, in [0, 255]
  double mean = 0.0;        // mean absolute difference of all channels
  double rmse = 0.0;        // root mean square difference of all channels
  double psnr = 0.0;        // [dB] 20 log10(255 / rmse); infinite for equal images
  double ssim = 1.0;        // structural similarity of the luma (Wang et al. 2004): 11 x 11 Gaussian, sigma 1.5
  double share_over = 0.0;  // share of the pixels in which a channel differs by more than `threshold`, in [0, 1]
};

/// Compares two images of one size row by row, from the top, and holds no more than eleven rows of them.
class RowComparison {
 public:
  /// What is known of an image before its rows.
  struct Shape {
    int width = 0, height = 0, channels = 3;
  };

  /// Throws InputError when the images are empty or not the same size.
  RowComparison(const Shape& a, const Shape& b, int threshold = 3);
  ~RowComparison();
  void add_row(const std::uint8_t* a, const std::uint8_t* b);
  /// Once all rows were added.
  Comparison finish();

 private:
  struct Similarity;

  Shape a_, b_;
  int threshold_;
  int max_ = 0;
  double sum_ = 0.0, squares_ = 0.0;
  std::size_t over_ = 0;
  std::unique_ptr<Similarity> similarity_;
};

/// Throws InputError when the images are empty or not the same size.
Comparison compare(const Image& a, const Image& b, int threshold = 3);

/// Whether the same scene may have given both on different machines: software rasterisers differ by up to 3 in 255, so
/// no channel may differ by more than 16 and at most 1 % of the pixels by more than 3. `comparison` made with threshold
/// 3. Across an edge a shift by one pixel changes more than that.
bool within_tolerance(const Comparison& comparison);

/// |a - b| of every colour channel times 8, clamped, of `width` pixels of images of so many channels: RGB.
void difference_row(const std::uint8_t* a, int a_channels, const std::uint8_t* b, int b_channels, int width,
                    std::uint8_t* row);

}  // namespace billow::render
