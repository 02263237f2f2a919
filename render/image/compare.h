// How far apart two images are.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/words.h"
#include "render/image/image.h"
#include "render/image/image_rows.h"
#include "render/image/similarity.h"

namespace billow::render {

/// What one channel differs by.
struct ChannelComparison {
  std::string name;
  double max = 0.0;       // largest difference of two values, as Comparison has it
  std::int64_t over = 0;  // pixels in which it differs by more than the threshold
};

/// Values of 8 bits are 0 to 255. Those of 16 bits are divided by 257, and so count to 255 too, in steps of 1/257.
/// Floats have units of their own, and white is 1. Two of them are apart by 255 |a - b| / max(1, |a|, |b|): of 255 as
/// the others are, and where they are larger than 1 in proportion. Both NaN are the same, and both infinite of one
/// sign; else what is not finite is infinitely far apart. Images without alpha count as opaque. Of masked images the
/// pixels that count.
struct Comparison {
  double max = 0.0;              // largest |a - b| of a channel: of 255; of floats finite, in their own units
  int worst_x = 0, worst_y = 0;  // the first pixel that is furthest apart, from the left and the top
  double mean = 0.0;             // mean |a - b| of all channels; of floats where it is finite
  double rmse = 0.0;             // root mean square |a - b| of all channels; of floats where it is finite
  double psnr = 0.0;             // [dB] 20 log10(white / rmse); infinite for equal images
  double ssim = 1.0;             // structural similarity (similarity.h) of what is seen; NaN where there are no colours
  std::int64_t pixels = 0;       // that count
  std::int64_t over = 0;         // of them, in which a channel differs by more than the threshold
  std::int64_t over_off_edges = 0;               // of these, with no edge of what differs within a pixel in both
  double share_over = 0.0;                       // over / pixels
  std::optional<double> flip = {};               // mean ꟻLIP (flip.h) of what is seen, where it was asked for
  Depth depth = Depth::bits8;                    // of the finer of the two
  double apart = 0.0;                            // [1/255] how far the worst pixel's values are apart
  std::string worst_channel = {};                // of that pixel
  Meaning worst_meaning = Meaning::quantity;     // of its values
  double worst_a = 0.0, worst_b = 0.0;           // and what its values are: of 8 bits 0 to 255, of 16 0 to 65535
  std::int64_t explained = 0;                    // pixels over the threshold but for edges nearby
  std::int64_t not_finite = 0;                   // values infinitely far apart
  std::int64_t both_nan = 0;                     // values that are NaN in both
  std::vector<ChannelComparison> channels = {};  // in the order of the images' channels
};

/// What is compared.
struct ComparisonOptions {
  double threshold = 3.0;     // [1/255] by which a channel may differ
  bool ignore_alpha = false;  // all but the channel A
  bool flip = false;          // ꟻLIP too, which takes longer than all else
  /// [pixel] how far edges may lie aside, 0 to 4. A value then differs by no more than it lies outside of the values
  /// that the other image has within so many pixels, both ways: where a silhouette or a texture is shifted by less,
  /// each image has between its neighbours what the other has. What is in neither's surroundings differs as before.
  /// ꟻLIP and SSIM are not touched.
  int edge = 0;
};

inline constexpr int largest_edge = 4;  // [pixel]

/// Compares two images of one size row by row, from the top, and holds no more than 21 rows of them.
class RowComparison {
 public:
  /// What is known of an image of interleaved 8-bit values before its rows.
  struct Shape {
    int width = 0, height = 0, channels = 3;
  };

  /// Both images have that shape. Throws InputError when it has no pixels.
  explicit RowComparison(const RowShape& shape, const ComparisonOptions& options = {});
  /// Throws InputError when the images are empty or not the same size.
  RowComparison(const Shape& a, const Shape& b, const ComparisonOptions& options = {});
  ~RowComparison();
  /// `counts`, where there is one, has a value for each pixel: 0 where it does not count.
  void add_row(const ValueRow& a, const ValueRow& b, const std::uint8_t* counts = nullptr);
  void add_row(const std::uint8_t* a, const std::uint8_t* b, const std::uint8_t* counts = nullptr);
  /// Once all rows were added. Throws InputError where no pixel counts.
  Comparison finish();

 private:
  struct Differences;
  struct Flips;

  void add_seen(const ValueRow& a, const ValueRow& b, const Eigen::ArrayXd& counted);

  RowShape shape_;
  int a_channels_ = 0, b_channels_ = 0;  // of interleaved 8-bit values
  std::int64_t pixels_ = 0;
  std::unique_ptr<Differences> differences_;
  std::unique_ptr<Similarity> similarity_;  // null where there are no colours
  std::unique_ptr<Flips> flips_;            // null there too, or where nobody asked
};

/// Throws InputError when the images are empty or not the same size.
Comparison compare(const Image& a, const Image& b, const ComparisonOptions& options = {});

/// Numbers that images can be judged by.
enum class Metric { max, rmse, psnr, ssim, flip };
Words<Metric> words(Metric);
/// The largest value that makes a limit of a metric.
double largest(Metric metric);
/// Whether a metric is of what is seen, and so of images with colours alone.
bool is_of_colours(Metric metric);

/// A metric and what it may be at most, or at least for those that are high for images that are alike (psnr, ssim).
struct MetricLimit {
  Metric metric = Metric::max;
  double limit = 0.0;
};

/// How far apart images may be that count as the same. By default as far as the same scene's are on different machines:
/// software rasterisers differ by up to 3 in 255. Across an edge a shift by one pixel changes more than that.
struct Tolerance {
  double worst = 16.0;                      // [1/255] no channel may differ by more
  double share = 0.01;                      // of the pixels may be over the threshold
  std::optional<std::int64_t> pixels = {};  // or so many, where there is a number
  std::vector<MetricLimit> metrics = {};    // where there are any, they alone decide
};

/// Of images with values infinitely far apart no metric but ssim and flip holds.
bool within_tolerance(const Comparison& comparison, const Tolerance& tolerance = {});

/// Which limits do not hold: "psnr 49.89 and not at least 60", or "allowed: 250 px over, worst 16". Empty where all
/// do, and where it is that two identities are not the same.
std::string broken_limits(const Comparison& comparison, const Tolerance& tolerance);

/// An identity as it is read elsewhere: a hash as eight hexadecimal digits.
std::string identity_text(Meaning meaning, double value);

/// In a line, what differs and where: "412 px over 3/255 (0.04 %), worst 31 at (640, 212), all within 1 px of an edge".
std::string difference_text(const Comparison& comparison, double threshold);

/// |a - b| of every colour channel times 8, clamped, of `width` pixels of images of so many channels: RGB.
void difference_row(const std::uint8_t* a, int a_channels, const std::uint8_t* b, int b_channels, int width,
                    std::uint8_t* row);
/// The same of rows of values. Of floats it is how far apart those of the channel are that are furthest, in grey.
void difference_row(const RowShape& shape, const ValueRow& a, const ValueRow& b, std::uint8_t* row);

}  // namespace billow::render
