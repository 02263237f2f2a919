// bodies: in a scene: cloths and soft bodies, their material, pins and place.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

#include "cli/colour_text.h"
#include "cli/scene_keys.h"
#include "cli/scene_parts.h"

namespace billow::cli {
namespace {

constexpr std::size_t max_name_length = 64;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

// A name must be usable in -D paths, where an index can stand in its place.
void check_name(const std::string& name, const std::string& where) {
  const bool digits_only = name.find_first_not_of("0123456789") == std::string::npos;
  const bool awkward = name.find_first_of(". \t\r\n=/\\") != std::string::npos;
  if (digits_only || awkward || name.size() > max_name_length)
    fail_at(where, fmt::format("the name '{}' will not do: up to {} characters, no blanks, none of . = / \\, "
                               "and not digits alone",
                               name.substr(0, max_name_length), max_name_length));
}

void read_surface_springs(MapReader& stiffness, sim::ClothOptions& options) {
  options.structural = stiffness.number("structural", options.structural);
  options.shear = stiffness.number("shear", options.shear);
  options.bend = stiffness.number("bend", options.bend);
}

void read_stiffness(MapReader& cloth, sim::ClothOptions& options) {
  MapReader map = cloth.map("stiffness", keys::stiffness);
  read_surface_springs(map, options);
  options.max_eigenvalue = map.number_or_word("max_eigenvalue");
}

void read_stiffness(MapReader& soft, sim::SoftBodyOptions& options) {
  MapReader map = soft.map("stiffness", keys::soft_stiffness);
  read_surface_springs(map, options.surface);
  options.interior = map.number("interior", options.interior);
  options.surface.max_eigenvalue = map.number_or_word("max_eigenvalue");
}

void read_damping(MapReader& cloth, sim::ClothOptions& options) {
  MapReader map = cloth.map("damping", keys::damping);
  options.damping_model = map.choice("model", options.damping_model);
  options.damping = map.number("coefficient", options.damping);
  options.friction = map.number("friction", options.friction);
}

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

Eigen::Matrix3d read_rotation(MapReader& transform) {
  const Node* node = transform.find("rotate");
  if (!node || node->kind != Node::Kind::map)
    return rotation_about_axes(transform.vector("rotate", Eigen::Vector3d::Zero()));
  MapReader map = transform.map("rotate", keys::axis_angle);
  return read_axis_angle(map);
}

void read_transform(MapReader& cloth, BodyDraft& draft) {
  MapReader map = cloth.map("transform", keys::transform);
  draft.scale = map.number("scale", draft.scale);
  draft.rotation = read_rotation(map);
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

PinDraft read_pin(const Node& node, const NodePtr& record) {
  MapReader pin(node, keys::pin, record);
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

void read_pins(MapReader& cloth, BodyDraft& draft) {
  std::vector<NodePtr> record;
  draft.pins_where = cloth.where("pins");
  if (const Node* node = cloth.find("pins")) {
    for (const NodePtr& item : read_list(*node, "pins")) {
      record.push_back(make_map());
      draft.pins.push_back(read_pin(*item, record.back()));
    }
  }
  cloth.record("pins", make_list(std::move(record)));
}

void read_mesh(MapReader& map, const std::filesystem::path& folder, BodyDraft& draft) {
  draft.spec.mesh_file = folder / map.text("mesh");
  draft.spec.mesh_where = map.where("mesh");
  read_transform(map, draft);
}

void read_mass(MapReader& map, sim::ClothOptions& options) {
  options.mass = map.number("mass", options.mass);
  enum class Distribution { area, uniform };
  const auto by_default = options.mass_by_area ? Distribution::area : Distribution::uniform;
  options.mass_by_area = map.choice("mass_distribution", by_default) == Distribution::area;
}

void read_cloth(MapReader& body, const std::filesystem::path& folder, BodyDraft& draft) {
  body.require("cloth");
  MapReader map = body.map("cloth", keys::cloth);
  sim::ClothOptions& options = draft.spec.cloth;
  options.name = draft.spec.name;
  read_mesh(map, folder, draft);
  read_mass(map, options);
  options.spring_model = map.choice("model", options.spring_model);
  read_stiffness(map, options);
  options.buckling_rigidity = map.number("buckling_rigidity", options.buckling_rigidity);
  read_damping(map, options);
  draft.spec.initial_velocity = map.vector("velocity", draft.spec.initial_velocity);
  read_pins(map, draft);
}

FormulaDraft read_formula(MapReader& map, std::string_view key) {
  return {map.text(key, FormulaDraft{}.text), map.where(key)};
}

void read_soft(MapReader& body, const std::filesystem::path& folder, BodyDraft& draft) {
  MapReader map = body.map("soft", keys::soft);
  sim::SoftBodyOptions& options = draft.spec.soft.emplace();
  options.surface.name = draft.spec.name;
  read_mesh(map, folder, draft);
  read_mass(map, options.surface);
  read_stiffness(map, options);
  MapReader variation = map.map("variation", keys::variation);
  draft.stiffness_factor = read_formula(variation, "stiffness");
  draft.mass_factor = read_formula(variation, "mass");
  read_damping(map, options.surface);
  draft.spec.initial_velocity = map.vector("velocity", draft.spec.initial_velocity);
  read_pins(map, draft);
}

// A body without any of the kinds misses `cloth`, the commonest.
std::string_view kind_of(const MapReader& body) {
  std::string_view kind;
  for (const std::string_view known : {"cloth", "soft", "fish"}) {
    if (!body.find(known)) continue;
    if (!kind.empty())
      fail_at(body.where(known),
              fmt::format("a body is a cloth, a soft body or a fish, and this one has '{}' and '{}'", kind, known));
    kind = known;
  }
  return kind.empty() ? "cloth" : kind;
}

void read_texture(MapReader& body, const std::filesystem::path& folder, BodyDraft& draft) {
  const std::string texture = body.text("texture", "none");
  draft.texture_where = body.where("texture");
  if (texture != "none") draft.spec.texture_file = folder / texture;
}

}  // namespace

BodyDraft read_body(const Node& node, int index, const std::filesystem::path& folder, const NodePtr& record) {
  MapReader map(node, keys::body, record);
  BodyDraft draft;
  draft.spec.name = map.text("name", fmt::format("body_{}", index));
  check_name(draft.spec.name, map.where("name"));
  const std::string_view kind = kind_of(map);
  if (kind == "cloth") read_cloth(map, folder, draft);
  if (kind == "soft") read_soft(map, folder, draft);
  if (kind == "fish") read_fish(map, folder, draft);
  read_texture(map, folder, draft);
  draft.spec.colour = read_colour(map, "colour", draft.spec.colour);
  return draft;
}

}  // namespace billow::cli
