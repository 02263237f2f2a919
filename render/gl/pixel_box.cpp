// Finding the part of the picture that bodies cover.
#include "render/gl/pixel_box.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace billow::render {

PixelBox joined(const PixelBox& a, const PixelBox& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.left, b.left), std::min(a.bottom, b.bottom), std::max(a.right, b.right), std::max(a.top, b.top)};
}

PixelBox overlap(const PixelBox& a, const PixelBox& b) {
  return {std::max(a.left, b.left), std::max(a.bottom, b.bottom), std::min(a.right, b.right), std::min(a.top, b.top)};
}

std::vector<PixelBox> split_evenly(int width, int height, int most_width, int most_height) {
  // Sides of an even number keep the 2 x 2 blocks whole that GL shades together.
  const auto side_of = [](int size, int most) {
    const int parts = (size + most - 1) / most, side = (size + parts - 1) / parts;
    return std::min(size, side + side % 2);
  };
  const int w = side_of(width, most_width), h = side_of(height, most_height);
  std::vector<PixelBox> boxes;
  for (int bottom = 0; bottom < height; bottom += h)
    for (int left = 0; left < width; left += w)
      boxes.push_back({left, bottom, std::min(left + w, width), std::min(bottom + h, height)});
  return boxes;
}

PixelBox covered_pixels(const Eigen::MatrixX3f& points, const Eigen::Matrix4f& view_projection, int width, int height) {
  if (points.rows() == 0) return {};
  const Eigen::MatrixX4f clip = points.rowwise().homogeneous() * view_projection.transpose();
  if (!(clip.col(3).minCoeff() > 0.0f)) return {0, 0, width, height};
  const Eigen::ArrayXf x = (0.5f + 0.5f * clip.col(0).array() / clip.col(3).array()) * static_cast<float>(width);
  const Eigen::ArrayXf y = (0.5f + 0.5f * clip.col(1).array() / clip.col(3).array()) * static_cast<float>(height);
  const auto pixel = [](float place, int size) {
    return static_cast<int>(std::clamp(std::floor(place), -1.0f, static_cast<float>(size)));
  };
  return {std::max(0, pixel(x.minCoeff(), width) - 1), std::max(0, pixel(y.minCoeff(), height) - 1),
          std::min(width, pixel(x.maxCoeff(), width) + 2), std::min(height, pixel(y.maxCoeff(), height) + 2)};
}

}  // namespace billow::render
