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
