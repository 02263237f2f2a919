// Reading and placing meshes that are bodies.
#include "cli/scene/mesh_body.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>

#include "cli/scene/motion_reader.h"
#include "cli/scene/scene_keys.h"
#include "cli/scene/scene_pins.h"
#include "sim/drawn/particle_order.h"
#include "sim/limit/stiffness_scale.h"

namespace billow::cli {

const Section& KindMap::section(std::string_view key) const { return keys::section(fmt::format("{}.{}", path, key)); }

KindMap kind_map(MapReader& body, std::string_view key) {
  const std::string path = fmt::format("bodies[].{}", key);
  return {body.map(key, keys::section(path)), path};
}

namespace {

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

sim::Selector read_selector(MapReader& pin, std::string_view key) {
  if (key == "corner") return pin.choice("corner", sim::Corner::top_left);
  if (key == "vertices") return read_vertices(pin);
  if (key == "box") return read_box(pin);
  if (key == "weights") {
    std::string name = pin.text("weights");
    return sim::WeightAbove{std::move(name), pin.number("over", sim::WeightAbove{}.bound)};
  }
  return sim::GroupName{pin.text("group")};
}

// A scene that starts with its pins elsewhere would begin with a blow.
std::vector<sim::PlaceKey> read_pin_motion(MapReader& pin) {
  std::vector<sim::PlaceKey> keys = read_place_keys(pin, "motion");
  if (!keys.empty() && !(keys[0].translation.isZero(0.0) && keys[0].rotation.isZero(0.0)))
    fail_at(pin.where("motion"),
            "a pin starts where the mesh has it, so the first key of its motion says a time and neither translate nor "
            "rotate");
  return keys;
}

std::optional<Eigen::Vector3d> read_pivot(MapReader& pin) {
  const Node* node = pin.find("pivot");
  if (node && !is_word(*node, "mean")) return pin.vector("pivot", Eigen::Vector3d::Zero());
  pin.record("pivot", make_scalar("mean"));
  return std::nullopt;
}

PinDraft read_pin(const Node& node, const Section& section, const NodePtr& record) {
  MapReader pin(node, section, record);
  std::vector<std::string_view> selectors;
  for (const std::string_view key : {"corner", "vertices", "box", "group", "weights"})
    if (pin.find(key)) selectors.push_back(key);
  if (selectors.size() != 1)
    fail_at(node.where,
            fmt::format("a pin has one of the keys corner, vertices, box, group and weights; this one has {}",
                        selectors.size()));
  if (pin.find("over") && selectors[0] != "weights")
    fail_at(pin.where("over"), "'over' bounds weights, and this pin has none; give it 'weights', or leave 'over' out");
  PinDraft draft;
  draft.where = pin.where(selectors[0]);
  draft.selector = read_selector(pin, selectors[0]);
  draft.motion = read_pin_motion(pin);
  draft.pivot = read_pivot(pin);
  draft.until = pin.number_or_word("until");
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
  MapReader transform = kind.submap("transform");
  draft.unit_given = transform.find("unit") || transform.find("scale");
  draft.placement = read_placement(transform, kind.section("transform.rotate"));
}

bool read_density(KindMap& kind, MeshBody& body) {
  body.density = kind.map.number_or_word("density");
  if (body.density && kind.map.find("mass"))
    fail_at(kind.map.where("density"), "density and mass both say what the body weighs; leave one of them out");
  return body.density.has_value();
}

void refuse_beside_material(KindMap& kind, std::string_view key) {
  if (kind.map.find(key))
    fail_at(kind.map.where(key),
            fmt::format("{} and material both say how hard the springs are; leave one of them out", key));
}

void read_mass(KindMap& kind, sim::ClothOptions& options) {
  options.mass = kind.map.number("mass", options.mass);
  read_mass_distribution(kind, options);
}

void read_mass_distribution(KindMap& kind, sim::ClothOptions& options) {
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

sim::Mesh placed(const sim::Mesh& mesh, const BodyDraft& draft) { return placed(mesh, draft.placement); }

namespace {

Eigen::Vector3d mean_position(const sim::Mesh& mesh, const std::vector<int>& vertices) {
  return mesh.position(vertices, Eigen::all).colwise().mean().transpose();
}

PinSpec placed_pin(const sim::Mesh& mesh, const PinDraft& draft) {
  PinSpec pin;
  pin.vertices = located(draft.where, [&] { return sim::select_vertices(mesh, draft.selector); });
  std::sort(pin.vertices.begin(), pin.vertices.end());
  pin.vertices.erase(std::unique(pin.vertices.begin(), pin.vertices.end()), pin.vertices.end());
  pin.motion = sim::KeyedMotion(draft.motion, draft.pivot ? *draft.pivot : mean_position(mesh, pin.vertices));
  pin.until = draft.until;
  return pin;
}

// Any number of pins may hold a vertex, as long as none moves it.
void check_only_one_moves(const std::vector<PinSpec>& pins, const std::vector<PinDraft>& drafts) {
  std::map<int, std::size_t> holder;  // the first pin of each vertex
  for (std::size_t p = 0; p < pins.size(); ++p)
    for (const int v : pins[p].vertices) {
      const std::size_t other = holder.try_emplace(v, p).first->second;
      if (other != p && (pins[p].motion.moves() || pins[other].motion.moves()))
        fail_at(drafts[p].where,
                fmt::format(
                    "vertex {} is already held by the pin at {}, and one of the two moves it; leave it to one of them",
                    v, drafts[other].where));
    }
}

}  // namespace

std::vector<PinSpec> placed_pins(const sim::Mesh& mesh, const BodyDraft& draft) {
  std::vector<PinSpec> pins;
  for (const PinDraft& pin : draft.pins) pins.push_back(placed_pin(mesh, pin));
  check_only_one_moves(pins, draft.pins);
  if (held_vertices(pins, 0.0).size() == static_cast<std::size_t>(mesh.vertices()))
    fail_at(draft.pins_where, "the pins hold every vertex, so nothing of the body can move");
  return pins;
}

sim::Structure scaled(sim::Structure structure, const MeshBody& body) {
  if (body.max_eigenvalue) sim::scale_stiffness(structure, *body.max_eigenvalue);
  return structure;
}

void MeshBody::add_laws(const Scene& scene, const sim::Structure& structure, int body, sim::Forces& forces) const {
  if (!scene.wind) return;
  const auto number = static_cast<std::size_t>(body);
  forces.add(std::make_unique<sim::WindForce>(structure, *scene.wind, scene.bodies[number].mesh.face,
                                              structure.body[number].first_particle));
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

sim::Mesh MeshBody::touching_mesh(const BodySpec& body) const { return body.mesh; }

}  // namespace billow::cli
