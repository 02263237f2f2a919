// Flat texture coordinates from positions.
#include "sim/mesh/planar_uv.h"

#include <Eigen/Geometry>

namespace billow::sim {
namespace {

struct Axes {
  Eigen::Vector3d right, up;
};

// right x up points at whoever looks: along +y on a mesh that lies flat, else along +z or +x. Equal extents (a cube)
// are looked at from the front.
Axes widest_axes(const Eigen::Vector3d& extent) {
  if (extent.y() < extent.x() && extent.y() < extent.z()) return {Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitZ()};
  if (extent.x() < extent.z()) return {-Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY()};
  return {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
}

}  // namespace

Eigen::MatrixX2d planar_uv(const Mesh& mesh) {
  const Eigen::RowVector3d extent = mesh.position.colwise().maxCoeff() - mesh.position.colwise().minCoeff();
  const Axes axes = widest_axes(extent);
  Eigen::MatrixX2d uv(mesh.vertices(), 2);
  uv << mesh.position * axes.right, mesh.position * axes.up;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = uv.col(axis).minCoeff(), width = uv.col(axis).maxCoeff() - low;
    uv.col(axis) = (uv.col(axis).array() - low) / (width > 0.0 ? width : 1.0);
  }
  return uv;
}

}  // namespace billow::sim
