// transform: in a scene.
#include "cli/scene/placement_reader.h"

#include <Eigen/Geometry>
#include <numbers>

namespace billow::cli {

namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

// [x, y, z] in degrees: about the fixed axes, x first, then y, then z.
Eigen::Matrix3d rotation_about_axes(const Eigen::Vector3d& degrees) {
  const auto about = [&](int axis) {
    return Eigen::AngleAxisd(radians(degrees(axis)), Eigen::Vector3d::Unit(axis)).toRotationMatrix();
  };
  return about(2) * about(1) * about(0);
}

Eigen::Matrix3d read_axis_angle(MapReader& map) {
  map.require("axis");
  const Eigen::Vector3d axis = map.vector("axis", Eigen::Vector3d::Zero());
  const double angle = map.number("angle");
  if (axis.norm() < 1e-12) fail_at(map.where("axis"), "axis has no direction: its length is 0");
  return Eigen::AngleAxisd(radians(angle), axis.normalized()).toRotationMatrix();
}

}  // namespace

Eigen::Matrix3d read_rotation(MapReader& map, const Section& axis_angle) {
  const Node* node = map.find("rotate");
  if (!node || node->kind != Node::Kind::map) return rotation_about_axes(map.vector("rotate", Eigen::Vector3d::Zero()));
  MapReader turn = map.map("rotate", axis_angle);
  return read_axis_angle(turn);
}

Placement read_placement(MapReader& transform, const Section& axis_angle) {
  Placement placement;
  placement.scale = transform.number("scale", placement.scale);
  placement.rotation = read_rotation(transform, axis_angle);
  placement.translation = transform.vector("translate", placement.translation);
  return placement;
}

sim::Mesh placed(const sim::Mesh& mesh, const Placement& placement) {
  return sim::transformed(mesh, placement.rotation, placement.scale, placement.translation);
}

}  // namespace billow::cli
