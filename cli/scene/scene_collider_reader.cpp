// colliders: in a scene: what bodies touch and cannot move.
#include <fmt/format.h>

#include "cli/scene/motion_reader.h"
#include "cli/scene/scene_files.h"
#include "cli/scene/scene_keys.h"
#include "cli/scene/scene_parts.h"
#include "sim/mesh/shapes.h"

namespace billow::cli {
namespace {

namespace fs = std::filesystem;

constexpr double least_length = 1e-9;  // [m] between points that must differ

// A level one by its height, any by a point and its normal.
void read_plane(MapReader& plane, const fs::path&, ColliderDraft& draft) {
  sim::HalfSpace solid;
  if (plane.find("height")) {
    for (const std::string_view key : {"point", "normal"})
      if (plane.find(key))
        fail_at(plane.where(key),
                fmt::format("a plane at a height is level and has no '{}'; leave one of both out", key));
    solid.point.y() = plane.number("height");
  } else {
    solid.point = plane.vector("point", solid.point);
    solid.normal = plane.vector("normal", solid.normal);
    if (solid.normal.norm() < least_length)
      fail_at(plane.where("normal"), "normal has no direction: its length is 0; [0, 1, 0] is a floor's");
    solid.normal.normalize();
  }
  draft.spec.solid.half_space = solid;
  draft.pivot = solid.point;
}

void read_sphere(MapReader& sphere, const fs::path&, ColliderDraft& draft) {
  draft.pivot = sphere.vector("centre", Eigen::Vector3d::Zero());
  const double radius = sphere.number("radius");
  draft.spec.solid.rounded = sim::Rounded{*draft.pivot, *draft.pivot, radius};
  draft.spec.solid.mesh = sim::sphere_mesh(*draft.pivot, radius);
}

/// What capsules and cylinders are described by.
struct Axis {
  Eigen::Vector3d from, to;
  double radius;
};

Axis read_axis(MapReader& shape, ColliderDraft& draft) {
  for (const std::string_view key : {"from", "to"}) shape.require(key);
  Axis axis;
  axis.from = shape.vector("from", Eigen::Vector3d::Zero());
  axis.to = shape.vector("to", Eigen::Vector3d::Zero());
  axis.radius = shape.number("radius");
  if ((axis.to - axis.from).norm() < least_length) fail_at(shape.where("to"), "to is where from is");
  draft.pivot = 0.5 * (axis.from + axis.to);
  return axis;
}

void read_capsule(MapReader& shape, const fs::path&, ColliderDraft& draft) {
  const Axis axis = read_axis(shape, draft);
  draft.spec.solid.rounded = sim::Rounded{axis.from, axis.to, axis.radius};
  draft.spec.solid.mesh = sim::capsule_mesh(axis.from, axis.to, axis.radius);
}

void read_cylinder(MapReader& shape, const fs::path&, ColliderDraft& draft) {
  const Axis axis = read_axis(shape, draft);
  draft.spec.solid.mesh = sim::cylinder_mesh(axis.from, axis.to, axis.radius);
}

void read_box(MapReader& box, const fs::path&, ColliderDraft& draft) {
  draft.pivot = box.vector("centre", Eigen::Vector3d::Zero());
  box.require("size");
  const Eigen::Vector3d size = box.vector("size", Eigen::Vector3d::Zero());
  const Eigen::Matrix3d rotation = read_rotation(box, keys::section("colliders[].box.rotate"));
  draft.spec.solid.mesh = sim::box_mesh(*draft.pivot, size, rotation);
}

void read_mesh_file(MapReader& mesh, const fs::path& folder, ColliderDraft& draft) {
  draft.spec.mesh_file = folder / mesh.text("file");
  draft.spec.mesh_where = mesh.where("file");
  MapReader transform = mesh.map("transform", keys::section("colliders[].mesh.transform"));
  draft.placement = read_placement(transform, keys::section("colliders[].mesh.transform.rotate"));
}

/// How a scene names a shape, and what reads it from there. Files are looked for below `folder`.
struct ShapeRow {
  std::string_view key;
  void (*read)(MapReader& shape, const fs::path& folder, ColliderDraft& draft);
};

constexpr ShapeRow shapes[] = {{"plane", read_plane},       {"sphere", read_sphere}, {"capsule", read_capsule},
                               {"cylinder", read_cylinder}, {"box", read_box},       {"mesh", read_mesh_file}};

const ShapeRow& shape_of(const MapReader& collider) {
  const ShapeRow* shape = nullptr;
  for (const ShapeRow& row : shapes) {
    if (!collider.find(row.key)) continue;
    if (shape)
      fail_at(collider.where(row.key),
              fmt::format("a collider has one shape, and this one has '{}' and '{}'; make it two colliders", shape->key,
                          row.key));
    shape = &row;
  }
  if (!shape) {
    std::vector<std::string_view> keys;
    for (const ShapeRow& row : shapes) keys.push_back(row.key);
    fail_at(collider.where(), fmt::format("a collider needs a shape, one of the keys '{}'", fmt::join(keys, "', '")));
  }
  return *shape;
}

// Rotations turn about the shape's centre where the scene names no pivot.
void read_collider_motion(MapReader& map, ColliderDraft& draft) {
  draft.motion = read_place_keys(map, "motion");
  const Node* node = map.find("pivot");
  if (node && !is_word(*node, "centre"))
    draft.pivot = map.vector("pivot", Eigen::Vector3d::Zero());
  else
    map.record("pivot", make_scalar("centre"));
}

Eigen::Vector3d box_centre(const sim::Mesh& mesh) {
  return 0.5 * (mesh.position.colwise().minCoeff() + mesh.position.colwise().maxCoeff()).transpose();
}

}  // namespace

ColliderDraft read_collider(const Node& node, int index, const fs::path& folder, const NodePtr& record) {
  MapReader map(node, keys::section("colliders[]"), record);
  ColliderDraft draft;
  sim::Collider& solid = draft.spec.solid;
  solid.name = map.text("name", fmt::format("collider_{}", index));
  check_name(solid.name, map.where("name"));
  const ShapeRow& row = shape_of(map);
  MapReader shape = map.map(row.key, keys::section(fmt::format("colliders[].{}", row.key)));
  row.read(shape, folder, draft);
  solid.thickness = map.number("thickness", solid.thickness);
  solid.friction = map.number("friction", solid.friction);
  read_collider_motion(map, draft);
  read_look(map, folder, draft.spec);
  return draft;
}

ColliderSpec load_collider(ColliderDraft draft, const FileWatch& watch, TextureBudget& budget) {
  ColliderSpec& spec = draft.spec;
  check_file(spec.mesh_file, "mesh", spec.mesh_where);
  if (!spec.mesh_file.empty()) spec.solid.mesh = load_mesh(spec.mesh_file, spec.mesh_where, watch);
  load_look(spec, spec.solid.mesh, spec.mesh_file, watch, budget);
  if (!spec.mesh_file.empty()) spec.solid.mesh = placed(spec.solid.mesh, draft.placement);
  spec.solid.motion = sim::KeyedMotion(draft.motion, draft.pivot ? *draft.pivot : box_centre(spec.solid.mesh));
  return std::move(spec);
}

}  // namespace billow::cli
