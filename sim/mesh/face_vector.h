// The area vector of a face, and how it turns with the face's corners: what pressure acts along.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// From one corner of a face to another [m].
inline Eigen::RowVector3d side(const Eigen::MatrixX3d& position, const Face& face, int from, int to) {
  return position.row(face[to]) - position.row(face[from]);
}

/// Half the cross product of the diagonals [m^2]: A n of a flat quad, and of the mean of a bent quad's two
/// triangulations.
inline Eigen::RowVector3d area_vector(const Eigen::MatrixX3d& position, const Face& face) {
  if (corner_count(face) == 3) return 0.5 * side(position, face, 0, 1).cross(side(position, face, 0, 2));
  return 0.5 * side(position, face, 0, 2).cross(side(position, face, 1, 3));
}

/// cross_matrix(e) x = e x x. Where corner k moves by dx, the area vector changes by -cross_matrix(e) dx / 2, e being
/// across(position, face, k).
inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& e) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -e.z(), e.y(), e.z(), 0.0, -e.x(), -e.y(), e.x(), 0.0;
  return matrix;
}

/// From the corner before corner k to the one after it [m].
inline Eigen::Vector3d across(const Eigen::MatrixX3d& position, const Face& face, int k) {
  const int m = corner_count(face);
  return side(position, face, (k + m - 1) % m, (k + 1) % m).transpose();
}

}  // namespace billow::sim
