// Nearest points by the regions of Voronoi.
#include "sim/contact/closest_points.h"

#include <algorithm>

namespace billow::sim {

namespace {

// Where on the segment from 0 to `along` a point at `to` projects, in [0, 1].
double share_along(const Eigen::Vector3d& along, const Eigen::Vector3d& to) {
  const double square = along.squaredNorm();
  return square > 0.0 ? std::clamp(along.dot(to) / square, 0.0, 1.0) : 0.0;
}

// The best of the three edges, for points that do not project into the triangle.
Eigen::Vector3d nearest_on_border(const Eigen::Vector3d& p, const Eigen::Vector3d (&corner)[3]) {
  Eigen::Vector3d best = Eigen::Vector3d::UnitX();
  double least = INFINITY;
  for (int e = 0; e < 3; ++e) {
    const Eigen::Vector3d &from = corner[e], &to = corner[(e + 1) % 3];
    const double share = share_along(to - from, p - from);
    const double square = (from + share * (to - from) - p).squaredNorm();
    if (!(square < least)) continue;
    least = square;
    best.setZero();
    best(e) = 1.0 - share;
    best((e + 1) % 3) = share;
  }
  return best;
}

}  // namespace

Eigen::Vector3d nearest_in_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c) {
  const Eigen::Vector3d u = b - a, v = c - a, w = p - a;
  const double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm(), wu = w.dot(u), wv = w.dot(v);
  const double area = uu * vv - uv * uv;  // its square, times 4
  const double beta = vv * wu - uv * wv, gamma = uu * wv - uv * wu;
  constexpr double flat = 1e-14;  // a triangle so thin has no inside
  if (area > flat * uu * vv && beta >= 0.0 && gamma >= 0.0 && beta + gamma <= area)
    return {1.0 - (beta + gamma) / area, beta / area, gamma / area};
  return nearest_on_border(p, {a, b, c});
}

Eigen::Vector2d nearest_on_segments(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1, const Eigen::Vector3d& q0,
                                    const Eigen::Vector3d& q1) {
  const Eigen::Vector3d d = p1 - p0, e = q1 - q0, r = p0 - q0;
  const double dd = d.squaredNorm(), ee = e.squaredNorm(), de = d.dot(e), dr = d.dot(r), er = e.dot(r);
  const double cross = dd * ee - de * de;
  constexpr double parallel = 1e-14;
  double s = cross > parallel * dd * ee ? std::clamp((de * er - dr * ee) / cross, 0.0, 1.0) : 0.5;
  const double t = ee > 0.0 ? std::clamp((de * s + er) / ee, 0.0, 1.0) : 0.0;
  s = dd > 0.0 ? std::clamp((de * t - dr) / dd, 0.0, 1.0) : 0.0;
  return {s, t};
}

Nearest nearest_points(const std::array<int, 4>& vertex, int on_a, const std::vector<Eigen::Vector3d>& x) {
  const Eigen::Vector3d &a = x[vertex[0]], &b = x[vertex[1]], &c = x[vertex[2]], &d = x[vertex[3]];
  if (on_a == 1) {
    const Eigen::Vector3d at = nearest_in_triangle(a, b, c, d);
    return {{1.0, -at(0), -at(1), -at(2)}, a - at(0) * b - at(1) * c - at(2) * d};
  }
  const Eigen::Vector2d at = nearest_on_segments(a, b, c, d);
  return {{1.0 - at(0), at(0), at(1) - 1.0, -at(1)}, (1.0 - at(0)) * a + at(0) * b - (1.0 - at(1)) * c - at(1) * d};
}

}  // namespace billow::sim
