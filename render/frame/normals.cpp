// Angle-weighted point normals.
#include "render/frame/normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace billow::render {
namespace {

constexpr float least_length = 1e-6f;

float angle_between(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

void add_triangle(const Eigen::Vector3i& points, const Eigen::MatrixX3f& position, Eigen::MatrixX3f& normal) {
  Eigen::Vector3f corner[3];
  for (int k = 0; k < 3; ++k) corner[k] = position.row(points(k)).transpose();
  const Eigen::Vector3f cross = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  const float twice_area = cross.norm();
  if (!(twice_area > 0.0f)) return;
  for (int k = 0; k < 3; ++k) {
    const float angle = angle_between(corner[(k + 1) % 3] - corner[k], corner[(k + 2) % 3] - corner[k]);
    normal.row(points(k)) += (angle / twice_area) * cross.transpose();
  }
}

}  // namespace

Eigen::MatrixX3f point_normals(const sim::Surface& surface, const Eigen::MatrixX3f& position) {
  Eigen::MatrixX3f normal = Eigen::MatrixX3f::Zero(position.rows(), 3);
  for (Eigen::Index t = 0; t < surface.triangle.rows(); ++t) {
    const Eigen::Vector3i points(surface.point(surface.triangle(t, 0)), surface.point(surface.triangle(t, 1)),
                                 surface.point(surface.triangle(t, 2)));
    add_triangle(points, position, normal);
  }
  const Eigen::VectorXf length = normal.rowwise().norm();
  for (Eigen::Index p = 0; p < normal.rows(); ++p) {
    if (length(p) > least_length)
      normal.row(p) /= length(p);
    else
      normal.row(p).stableNormalize();  // faces that cancel each other: the squares of what is left would vanish
  }
  return normal;
}

}  // namespace billow::render
