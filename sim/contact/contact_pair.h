// Two features of a surface that are near each other.
#pragma once

#include <Eigen/Core>
#include <array>

namespace billow::sim {

/// Of the distance that surfaces keep: they never come nearer to each other than this share of it.
constexpr double least_share = 0.1;

/// A vertex and a triangle, or two edges. Side a is the vertex, or the first edge; the difference of the nearest points
/// is sum_k weight[k] x[vertex[k]], the weights of side a summing to 1 and those of side b to -1.
struct ContactPair {
  std::array<int, 4> vertex;
  std::array<double, 4> weight;
  int on_a;  // corners of side a, which come first: 1 or 2
  // Whether it stands for its nearest points. Where these lie on a border that other pairs have too, one of them does:
  // the others only keep their planes.
  bool acts = true;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, from b to a
  double thickness = 0.0;                            // [m] the distance that the surfaces keep
  double radius = 0.0;                               // [m] of what is solid around either side's points
  double friction = 0.0;                             // Coulomb's
  // As long as side a stays where normal . x >= bound_a + drift t and side b where normal . x <= bound_b + drift t, t
  // [s] after the detection, the two cannot meet: a plane lies between them.
  double bound_a = 0.0, bound_b = 0.0, drift = 0.0;
  // [m] how far a side's corners may stray from its part's mean motion before their bound can be broken, at first; and
  // how fast [m/s] that becomes less, the part moving otherwise than the plane.
  double slack_a = 0.0, slack_b = 0.0, loss_a = 0.0, loss_b = 0.0;
};

}  // namespace billow::sim
