// The nearest points of two simple shapes, as weights of their corners.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace billow::sim {

/// Weights (3), none negative, their sum 1, of the corners of the triangle abc: its point nearest to p. Of a triangle
/// without area the nearest point of its edges.
Eigen::Vector3d nearest_in_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c);

/// (s, t) in [0, 1]^2: p0 + s (p1 - p0) and q0 + t (q1 - q0) are as near as the segments come. Of parallel ones that
/// overlap, one of the nearest pairs.
Eigen::Vector2d nearest_on_segments(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1, const Eigen::Vector3d& q0,
                                    const Eigen::Vector3d& q1);

/// The nearest points of two features: their difference [m] is sum_k weight[k] x[vertex[k]].
struct Nearest {
  std::array<double, 4> weight;  // of the first feature's corners, which sum to 1, then of the second's, to -1
  Eigen::Vector3d difference;
};

/// Of a vertex and a triangle (`on_a` 1) or of two edges (2), with corners `vertex` of `x` (N) [m].
Nearest nearest_points(const std::array<int, 4>& vertex, int on_a, const std::vector<Eigen::Vector3d>& x);

}  // namespace billow::sim
