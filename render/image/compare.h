// How far apart two images are.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/words.h"
#include "render/image/image.h"

namespace billow::render {

/// Differences are between 8-bit channel values; images without alpha count as opaque. Of masked images the pixels that
/// count.
struct Comparison {
  int max = 0;                      // largest difference of a channel, in [0, 255]
  int worst_x = 0, worst_y = 0;     // the first pixel that has it, from the left and the top
  double mean = 0.0;                // mean absolute difference of all channels
  double rmse = 0.0;                // root mean square difference of all channels
  double psnr = 0.0;                // [dB] 20 log10(255 / rmse); infinite for equal images
  double ssim = 1.0;                // structural similarity of the luma (Wang et al. 2004): 11 x 11 Gaussian, sigma 1.5
  std::int64_t pixels = 0;          // that count
  std::int64_t over = 0;            // of them, in which a channel differs by more than the threshold
  std::int64_t over_off_edges = 0;  // of these, with no edge that both images have within a pixel
  double share_over = 0.0;          // over / pixels
  std::optional<double> flip = {};  // mean ꟻLIP (flip.h), where it was asked for
};

/// What is compared.
struct ComparisonOptions {
  int threshold = 3;          // [1/255] by which a channel may differ
  bool ignore_alpha = false;  // only red, green and blue
  bool flip = false;          // ꟻLIP too, which takes longer than all else
};

/// Compares two images of one size row by row, from the top, and holds no more than 21 rows of them.
class RowComparison {
 public:
  /// What is known of an image before its rows.
  struct Shape {
    int width = 0, height = 0, channels = 3;
  };

  /// Throws InputError when the images are empty or not the same size.
  RowComparison(const Shape& a, const Shape& b, const ComparisonOptions& options = {});
  ~RowComparison();
  /// `counts`, where there is one, has a value for each pixel: 0 where it does not count.
  void add_row(const std::uint8_t* a, const std::uint8_t* b, const std::uint8_t* counts = nullptr);
  /// Once all rows were added. Throws InputError where no pixel counts.
  Comparison finish();

 private:
  struct Similarity;
  struct Edges;
  struct Flips;

  int width_, a_channels_, b_channels_, channels_, threshold_;
  std::int64_t rows_ = 0;
  double sum_ = 0.0, squares_ = 0.0;
  Comparison result_;
  std::unique_ptr<Similarity> similarity_;
  std::unique_ptr<Edges> edges_;
  std::unique_ptr<Flips> flips_;  // null where nobody asked
};

/// Throws InputError when the images are empty or not the same size.
Comparison compare(const Image& a, const Image& b, const ComparisonOptions& options = {});

/// Numbers that images can be judged by.
enum class Metric { max, rmse, psnr, ssim, flip };
Words<Metric> words(Metric);
/// The largest value that makes a limit of a metric.
double largest(Metric metric);

/// A metric and what it may be at most, or at least for those that are high for images that are alike (psnr, ssim).
struct MetricLimit {
  Metric metric = Metric::max;
  double limit = 0.0;
};

/// How far apart images may be that count as the same. By default as far as the same scene's are on different machines:
/// software rasterisers differ by up to 3 in 255. Across an edge a shift by one pixel changes more than that.
struct Tolerance {
  int worst = 16;                           // [1/255] no channel may differ by more
  double share = 0.01;                      // of the pixels may be over the threshold
  std::optional<std::int64_t> pixels = {};  // or so many, where there is a number
  std::vector<MetricLimit> metrics = {};    // where there are any, they alone decide
};

bool within_tolerance(const Comparison& comparison, const Tolerance& tolerance = {});

/// In a line, what differs and where: "412 px over 3/255 (0.04 %), worst 31 at (640, 212), all within 1 px of an edge".
std::string difference_text(const Comparison& comparison, int threshold);

/// |a - b| of every colour channel times 8, clamped, of `width` pixels of images of so many channels: RGB.
void difference_row(const std::uint8_t* a, int a_channels, const std::uint8_t* b, int b_channels, int width,
                    std::uint8_t* row);

}  // namespace billow::render
