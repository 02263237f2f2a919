// A rectangle of pixels.
#pragma once

#include <Eigen/Core>

namespace billow::render {

/// Pixels left <= x < right, bottom <= y < top, counted from the lower left corner as GL does.
struct PixelBox {
  int left = 0, bottom = 0, right = 0, top = 0;

  int width() const { return right - left; }
  int height() const { return top - bottom; }
  bool empty() const { return width() <= 0 || height() <= 0; }
};

/// The smallest box around both.
PixelBox joined(const PixelBox& a, const PixelBox& b);

/// The pixels of a width x height picture that the points (p x 3) [m] span, with one to spare on each side; the whole
/// picture when a point lies behind the eye.
PixelBox covered_pixels(const Eigen::MatrixX3f& points, const Eigen::Matrix4f& view_projection, int width, int height);

}  // namespace billow::render
