// How far apart two images are.
#pragma once

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

/// Throws InputError when the images are empty or not the same size.
Comparison compare(const Image& a, const Image& b, int threshold = 3);

/// Whether the same scene may have given both on different machines: software rasterisers differ by up to 3 in 255, so
/// no channel may differ by more than 16 and at most 1 % of the pixels by more than 3. `comparison` made with threshold
/// 3. Across an edge a shift by one pixel changes more than that.
bool within_tolerance(const Comparison& comparison);

/// |a - b| of every colour channel times `gain`, clamped: RGB. Throws as compare() does.
Image difference(const Image& a, const Image& b, int gain = 8);

}  // namespace billow::render
