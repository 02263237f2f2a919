// Reading and placing meshes that are bodies.
#include "cli/scene/mesh_body.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <numeric>

#include "cli/scene/scene_keys.h"
#include "sim/drawn/particle_order.h"
#include "sim/limit/stiffness_scale.h"

namespace billow::cli {

const Section& KindMap::section(std::string_view key) const { return keys::section(fmt::format("{}.{}", path, key)); }

KindMap kind_map(MapReader& body, std::string_view key) {
  const std::string path = fmt::format("bodies[].{}", key);
  return {body.map(key, keys::section(path)), path};
}

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

Eigen::Matrix3d read_rotation(MapReader& transform, const Section& axis_angle) {
  const Node* node = transform.find("rotate");
  if (!node || node->kind != Node::Kind::map)
    return rotation_about_axes(transform.vector("rotate", Eigen::Vector3d::Zero()));
  MapReader map = transform.map("rotate", axis_angle);
  return read_axis_angle(map);
}

void read_transform(KindMap& kind, BodyDraft& draft) {
  MapReader map = kind.submap("transform");
  draft.scale = map.number("scale", draft.scale);
  draft.rotation = read_rotation(map, kind.section("transform.rotate"));
  draft.translation = map.vector("translate", draft.translation);
}

sim::VertexList read_vertices(MapReader& pin) {
  sim::VertexList list;
  std::vector<NodePtr> record;
  for (const NodePtr& item : read_list(pin.require("vertices"), "vertices")) {
    list.vertices.push_back(read_integer(*item, "vertex", pin.key("vertices").range));
    record.push_back(make_scalar(std::to_string(list.vertices.back())));
  }
  pin.record("vertices", make_list(std::move(record)));
  return list;
}

Eigen::AlignedBox3d read_box(MapReader& pin) {
  const Node& node = pin.require("box");
  const std::vector<NodePtr>& corners = read_list(node, "box");
  if (corners.size() != 2) fail_at(node.where, "box must be a list of two corners [[x, y, z], [x, y, z]]");
  const Range& range = pin.key("box").range;
  const Eigen::AlignedBox3d box{read_vector(*corners[0], "box[0]", range), read_vector(*corners[1], "box[1]", range)};
  if (box.isEmpty()) fail_at(node.where, "box is empty: its first corner must be the lower one in x, y and z");
  pin.record("box", make_list({record_of(Eigen::Vector3d(box.min())), record_of(Eigen::Vector3d(box.max()))}));
  return box;
}

PinDraft read_pin(const Node& node, const Section& section, const NodePtr& record) {
  MapReader pin(node, section, record);
  if (node.entries.size() != 1)
    fail_at(node.where,
            fmt::format("a pin has one key, corner, vertices, box or group; this one has {}", node.entries.size()));
  const std::string& key = node.entries[0].key;
  PinDraft draft;
  draft.where = pin.where(key);
  if (key == "corner") draft.selector = pin.choice("corner", sim::Corner::top_left);
  if (key == "vertices") draft.selector = read_vertices(pin);
  if (key == "box") draft.selector = read_box(pin);
  if (key == "group") draft.selector = sim::GroupName{pin.text("group")};
  return draft;
}

void read_pins(KindMap& kind, BodyDraft& draft) {
  std::vector<NodePtr> record;
  draft.pins_where = kind.map.where("pins");
  if (const Node* node = kind.map.find("pins")) {
    for (const NodePtr& item : read_list(*node, "pins")) {
      record.push_back(make_map());
      draft.pins.push_back(read_pin(*item, kind.section("pins[]"), record.back()));
    }
  }
  kind.map.record("pins", make_list(std::move(record)));
}

}  // namespace

void read_mesh(KindMap& kind, const std::filesystem::path& folder, BodyDraft& draft) {
  draft.spec.mesh_file = folder / kind.map.text("mesh");
  draft.spec.mesh_where = kind.map.where("mesh");
  read_transform(kind, draft);
}

void read_mass(KindMap& kind, sim::ClothOptions& options) {
  options.mass = kind.map.number("mass", options.mass);
  options.mass_by_area = kind.map.word("mass_distribution", options.mass_by_area ? "area" : "uniform") == "area";
}

void read_surface_springs(MapReader& stiffness, sim::ClothOptions& options) {
  options.structural = stiffness.number("structural", options.structural);
  options.shear = stiffness.number("shear", options.shear);
  options.bend = stiffness.number("bend", options.bend);
}

void read_damping(KindMap& kind, sim::ClothOptions& options) {
  MapReader map = kind.submap("damping");
  options.damping_model = map.choice("model", options.damping_model);
  options.damping = map.number("coefficient", options.damping);
  options.friction = map.number("friction", options.friction);
}

void read_start(KindMap& kind, BodyDraft& draft) {
  draft.spec.initial_velocity = kind.map.vector("velocity", draft.spec.initial_velocity);
  read_pins(kind, draft);
}

sim::Mesh placed(const sim::Mesh& mesh, const BodyDraft& draft) {
  return sim::transformed(mesh, draft.rotation, draft.scale, draft.translation);
}

std::vector<int> pinned_vertices(const sim::Mesh& mesh, const BodyDraft& draft) {
  std::vector<int> pinned;
  for (const PinDraft& pin : draft.pins) {
    const auto selected = located(pin.where, [&] { return sim::select_vertices(mesh, pin.selector); });
    pinned.insert(pinned.end(), selected.begin(), selected.end());
  }
  std::sort(pinned.begin(), pinned.end());
  pinned.erase(std::unique(pinned.begin(), pinned.end()), pinned.end());
  if (pinned.size() == static_cast<std::size_t>(mesh.vertices()))
    fail_at(draft.pins_where, "the pins hold every vertex, so nothing of the body can move");
  return pinned;
}

sim::Structure scaled(sim::Structure structure, const MeshBody& body) {
  if (body.max_eigenvalue) sim::scale_stiffness(structure, *body.max_eigenvalue);
  return structure;
}

sim::Skin MeshBody::skin(const BodySpec& body) const { return {sim::build_surface(body.mesh)}; }

BodyRows MeshBody::rows(const BodySpec& body, StripOrder order) const {
  BodyRows rows;
  if (order == StripOrder::zigzag) {
    rows.particles = sim::zigzag_order(body.mesh);
  } else {
    rows.particles.resize(static_cast<std::size_t>(body.mesh.vertices()));
    std::iota(rows.particles.begin(), rows.particles.end(), 0);
  }
  return rows;
}

const sim::Mesh& MeshBody::particle_mesh(const BodySpec& body) const { return body.mesh; }

}  // namespace billow::cli
