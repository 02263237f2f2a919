// Convex polygons as fans, others by clipping ears.
#include "sim/mesh/polygon.h"

#include <Eigen/Geometry>
#include <numeric>

namespace billow::sim {
namespace {

// The polygon seen along its mean normal (Newell's), counter-clockwise.
Eigen::MatrixX2d flattened(const Eigen::MatrixX3d& corner) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  const Eigen::Index n = corner.rows();
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Vector3d a = corner.row(k) - corner.row(0), b = corner.row((k + 1) % n) - corner.row(0);
    normal += a.cross(b);
  }
  if (!(normal.norm() > 0.0)) return Eigen::MatrixX2d::Zero(n, 2);
  normal.normalize();
  const Eigen::Vector3d across = normal.unitOrthogonal(), up = normal.cross(across);
  Eigen::MatrixX2d flat(n, 2);
  flat.col(0) = (corner.rowwise() - corner.row(0)) * across;
  flat.col(1) = (corner.rowwise() - corner.row(0)) * up;
  return flat;
}

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool is_convex(const Eigen::MatrixX2d& flat) {
  const Eigen::Index n = flat.rows();
  const double rounding = 1e-9 * flat.cwiseAbs2().rowwise().sum().maxCoeff();
  for (Eigen::Index k = 0; k < n; ++k)
    if (turn(flat.row(k), flat.row((k + 1) % n), flat.row((k + 2) % n)) < -rounding) return false;
  return true;
}

// Whether the k-th corner of the rest can be cut off: it turns left and no other corner lies in its triangle.
bool is_ear(const Eigen::MatrixX2d& flat, const std::vector<int>& rest, std::size_t k) {
  const std::size_t n = rest.size();
  const Eigen::Vector2d a = flat.row(rest[(k + n - 1) % n]), b = flat.row(rest[k]), c = flat.row(rest[(k + 1) % n]);
  if (!(turn(a, b, c) > 0.0)) return false;
  for (std::size_t other = 0; other < n; ++other) {
    if (other == k || other == (k + 1) % n || other == (k + n - 1) % n) continue;
    const Eigen::Vector2d p = flat.row(rest[other]);
    if (p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
  }
  return true;
}

std::vector<Face> clip_ears(const Eigen::MatrixX2d& flat) {
  std::vector<int> rest(static_cast<std::size_t>(flat.rows()));
  std::iota(rest.begin(), rest.end(), 0);
  std::vector<Face> faces;
  while (rest.size() > 3) {
    std::size_t ear = 0;
    while (ear < rest.size() && !is_ear(flat, rest, ear)) ++ear;
    if (ear == rest.size()) ear = 1;  // it crosses itself: any triangles will do
    const std::size_t n = rest.size();
    faces.push_back({rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n], -1});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  faces.push_back({rest[0], rest[1], rest[2], -1});
  return faces;
}

constexpr Eigen::Index most_clipped_corners = 2000;  // clipping takes n^3 at worst; only such polygons are fans anyway

}  // namespace

std::vector<Face> polygon_faces(const Eigen::MatrixX3d& corner) {
  const auto n = static_cast<int>(corner.rows());
  if (n < 3) return {};
  if (n == 3) return {{0, 1, 2, -1}};
  if (n == 4) return {{0, 1, 2, 3}};
  const Eigen::MatrixX2d flat = flattened(corner);
  if (!is_convex(flat) && n <= most_clipped_corners) return clip_ears(flat);
  std::vector<Face> fan;
  for (int k = 2; k < n; ++k) fan.push_back({0, k - 1, k, -1});
  return fan;
}

}  // namespace billow::sim
