// How different two images look to somebody who flips between them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>

namespace billow::render {

/// ꟻLIP of images of 8-bit sRGB colours (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: "ꟻLIP: A
/// Difference Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020): for each pixel
/// in [0, 1] what is seen of the difference in colour, by the eye's contrast sensitivity, and of edges and points that
/// only one image has. Rows go in from the top and come out some ten rows later, so that no more than a few are held.
class Flip {
 public:
  /// Is given row `y` of the errors: `width` values.
  using Take = std::function<void(int y, const Eigen::ArrayXd& errors)>;

  /// As seen from where a degree of the visual angle is `pixels_per_degree` wide: by default the paper's, 0.7 m before
  /// a screen 0.7 m and 3840 pixels wide.
  Flip(int width, int height, Take take, double pixels_per_degree = default_pixels_per_degree);
  ~Flip();
  /// The next row of both images, of so many channels each; alpha is not looked at.
  void add_row(const std::uint8_t* reference, int reference_channels, const std::uint8_t* test, int test_channels);
  /// Call it after the last row: the errors that are missing come out.
  void finish();

  static constexpr double default_pixels_per_degree = 67.020643276582255;  // 3840 pi / 180

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace billow::render
