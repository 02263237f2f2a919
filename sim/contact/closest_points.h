// The nearest points of two simple shapes, as weights of their corners.
#pragma once

#include <Eigen/Core>

namespace billow::sim {

/// Weights (3), none negative, their sum 1, of the corners of the triangle abc: its point nearest to p. Of a triangle
/// without area the nearest point of its edges.
Eigen::Vector3d nearest_in_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c);

/// (s, t) in [0, 1]^2: p0 + s (p1 - p0) and q0 + t (q1 - q0) are as near as the segments come. Of parallel ones that
/// overlap, one of the nearest pairs.
Eigen::Vector2d nearest_on_segments(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1, const Eigen::Vector3d& q0,
                                    const Eigen::Vector3d& q1);

}  // namespace billow::sim
