// A rectangle of pixels.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace billow::render {

/// Pixels left <= x < right, bottom <= y < top, counted from the lower left corner as GL does.
struct PixelBox {
  int left = 0, bottom = 0, right = 0, top = 0;

  int width() const { return right - left; }
  int height() const { return top - bottom; }
  bool empty() const { return width() <= 0 || height() <= 0; }
  bool operator==(const PixelBox&) const = default;
};

/// The smallest box around both.
PixelBox joined(const PixelBox& a, const PixelBox& b);

/// What they have in common; empty where that is nothing.
PixelBox overlap(const PixelBox& a, const PixelBox& b);

/// A picture of width x height pixels as the fewest boxes of about the same size, none of more than so many pixels each
/// way, in rows from the lower left.
std::vector<PixelBox> split_evenly(int width, int height, int most_width, int most_height);

/// The pixels of a width x height picture that the points (p x 3) [m] span, with one to spare on each side; the whole
/// picture when a point lies behind the eye.
PixelBox covered_pixels(const Eigen::MatrixX3f& points, const Eigen::Matrix4f& view_projection, int width, int height);

}  // namespace billow::render
