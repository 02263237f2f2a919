// transform: in a scene.
#include "cli/scene/placement_reader.h"

#include <Eigen/Geometry>

#include "cli/scene/scene_parts.h"

namespace billow::cli {

namespace {

// [x, y, z] in degrees: about the fixed axes, x first, then y, then z.
Eigen::Matrix3d rotation_about_axes(const Eigen::Vector3d& degrees) {
  const auto about = [&](int axis) {
    return Eigen::AngleAxisd(radians(degrees(axis)), Eigen::Vector3d::Unit(axis)).toRotationMatrix();
  };
  return about(2) * about(1) * about(0);
}

struct UnitRow {
  LengthUnit unit;
  std::string_view word;
  double metres;
};

constexpr UnitRow units[] = {{LengthUnit::metre, "m", 1.0},         {LengthUnit::decimetre, "dm", 0.1},
                             {LengthUnit::centimetre, "cm", 0.01},  {LengthUnit::millimetre, "mm", 0.001},
                             {LengthUnit::kilometre, "km", 1000.0}, {LengthUnit::inch, "in", 0.0254},
                             {LengthUnit::foot, "ft", 0.3048}};

double metres(LengthUnit unit) { return row_for(units, &UnitRow::unit, unit).metres; }

// One factor, or one for each axis.
Eigen::Vector3d read_scale(MapReader& transform) {
  const Node* node = transform.find("scale");
  if (!node || node->kind != Node::Kind::list) return Eigen::Vector3d::Constant(transform.number("scale", 1.0));
  return transform.vector("scale", Eigen::Vector3d::Ones());
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
  placement.unit = transform.choice("unit", placement.unit);
  placement.z_up = transform.boolean("z_up", placement.z_up);
  placement.scale = read_scale(transform);
  placement.rotation = read_rotation(transform, axis_angle);
  placement.translation = transform.vector("translate", placement.translation);
  return placement;
}

sim::Mesh placed(const sim::Mesh& mesh, const Placement& placement) {
  Eigen::Matrix3d upright = Eigen::Matrix3d::Identity();
  if (placement.z_up) upright << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const Eigen::Matrix3d linear = placement.rotation * (metres(placement.unit) * placement.scale).asDiagonal() * upright;
  return sim::transformed(mesh, linear, placement.translation);
}

Words<LengthUnit> words(LengthUnit) {
  static constexpr auto list = words_of(units, &UnitRow::word, &UnitRow::unit);
  return list;
}

}  // namespace billow::cli
