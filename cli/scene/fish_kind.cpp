// fish: in a body: flesh, place and motion.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>
#include <numeric>

#include "cli/scene/scene_keys.h"
#include "cli/scene/scene_parts.h"
#include "cli/text/number_text.h"
#include "sim/drawn/fish_skin.h"
#include "sim/force/buoyancy.h"
#include "sim/force/muscle_force.h"
#include "sim/force/water_force.h"

namespace billow::cli {
namespace {

void read_rings(MapReader& mass, std::array<double, sim::fish_rings>& rings) {
  const Key& key = mass.key("rings");
  if (const Node* node = mass.find("rings")) {
    const std::vector<NodePtr>& items = read_list(*node, "rings");
    if (items.size() != rings.size())
      fail_at(node->where, fmt::format("rings must list {} masses, from head to tail", rings.size()));
    for (std::size_t r = 0; r < rings.size(); ++r)
      rings[r] = read_number(*items[r], fmt::format("rings[{}]", r), key.range);
  }
  std::vector<NodePtr> record;
  for (const double ring : rings) record.push_back(record_of(ring));
  mass.record("rings", make_list(std::move(record)));
}

void read_mass(MapReader& fish, sim::FishMass& mass) {
  MapReader map = fish.map("mass", keys::section("bodies[].fish.mass"));
  mass.snout = map.number("snout", mass.snout);
  read_rings(map, mass.ring);
  mass.tail_tip = map.number("tail_tip", mass.tail_tip);
}

void read_stiffness(MapReader& fish, sim::FishOptions& options) {
  MapReader map = fish.map("stiffness", keys::section("bodies[].fish.stiffness"));
  options.cross = map.number("cross", options.cross);
  options.normal = map.number("normal", options.normal);
  options.muscle = map.number("muscle", options.muscle);
}

sim::MotionKey read_motion_key(const Node& node, const NodePtr& record) {
  MapReader map(node, keys::section("bodies[].fish.motion.keys[]"), record);
  sim::MotionKey key;
  key.time = map.number("time", key.time);
  key.swim = map.number("swim", key.swim);
  key.turn = map.number("turn", key.turn);
  key.frequency = map.number("frequency", key.frequency);
  return key;
}

void check_spacing(const Node& node, const sim::MotionOptions& motion) {
  for (std::size_t k = 1; k < motion.keys.size(); ++k)
    if (motion.keys[k].time - motion.keys[k - 1].time < motion.transition)
      fail_at(node.items[k]->where, fmt::format("keys[{}] must come at least the transition of {} s after keys[{}]", k,
                                                shortest(motion.transition), k - 1));
}

// One key: swimming straight ahead.
NodePtr default_keys() {
  NodePtr key = make_map();
  key->entries.push_back({"swim", {}, make_scalar("0.5")});
  return make_list({key});
}

// An empty list keeps the fish still.
void read_keys(MapReader& map, sim::MotionOptions& motion) {
  const NodePtr unnamed = default_keys();
  const Node* given = map.find("keys");
  const Node& node = given ? *given : *unnamed;
  std::vector<NodePtr> record;
  for (const NodePtr& item : read_list(node, "keys")) {
    record.push_back(make_map());
    motion.keys.push_back(read_motion_key(*item, record.back()));
  }
  check_spacing(node, motion);
  map.record("keys", make_list(std::move(record)));
}

void read_motion(MapReader& fish, sim::MotionOptions& motion) {
  constexpr double degree = std::numbers::pi / 180.0;
  MapReader map = fish.map("motion", keys::section("bodies[].fish.motion"));
  motion.transition = map.number("transition", motion.transition);
  motion.lag = radians(map.number("lag", 90.0));
  motion.phase = radians(map.number("phase", motion.phase / degree));
  read_keys(map, motion);
}

}  // namespace

void read_fish(MapReader& body, const std::filesystem::path& folder, BodyDraft& draft) {
  MapReader map = body.map("fish", keys::section("bodies[].fish"));
  FishSpec fish;
  const std::string skin = map.text("skin", "none");
  if (skin != "none") draft.spec.mesh_file = folder / skin;
  draft.spec.mesh_where = map.where("skin");
  fish.options = sim::fish_of_length(map.number("length", sim::default_fish_length));
  fish.options.name = draft.spec.name;
  read_mass(map, fish.options.mass);
  read_stiffness(map, fish.options);
  fish.options.viscosity = map.number("viscosity", fish.options.viscosity);
  fish.options.position = map.vector("position", fish.options.position);
  const double heading = radians(map.number("heading", 0.0));
  fish.options.rotation = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitY()).toRotationMatrix();
  draft.spec.initial_velocity = map.vector("velocity", draft.spec.initial_velocity);
  fish.buoyancy = map.number("buoyancy", fish.buoyancy);
  read_motion(map, fish.motion);
  draft.spec.kind = std::move(fish);
}

ContactSpec FishSpec::contact_by_kind() const { return {.self = false}; }

// Without what it is dressed in, which may stand out between its particles.
sim::Mesh FishSpec::touching_mesh(const BodySpec&) const {
  sim::Mesh mesh;
  mesh.position = sim::build_fish(options).rest_position;
  mesh.face = sim::fish_faces();
  return mesh;
}

void FishSpec::place(const sim::Mesh& mesh, const BodyDraft&, BodySpec& body) { body.mesh = mesh; }

sim::Structure FishSpec::build(const BodySpec&) const { return sim::build_fish(options); }

void FishSpec::add_laws(const Scene& scene, const sim::Structure& structure, int body, sim::Forces& forces) const {
  const int first = structure.body[static_cast<std::size_t>(body)].first_particle;
  forces.add(std::make_unique<sim::MuscleForce>(structure, body, sim::FishMotion(motion)));
  forces.add(std::make_unique<sim::WaterForce>(structure, scene.water, sim::fish_faces(), first));
  forces.add(std::make_unique<sim::Buoyancy>(structure, body, scene.gravity, buoyancy));
}

sim::Skin FishSpec::skin(const BodySpec& body) const {
  return body.mesh_file.empty() ? sim::plain_fish_skin() : sim::bind_fish_skin(body.mesh, options.length);
}

// Along the axis the sides' breathing in and out cancels and the swimming wave remains.
BodyRows FishSpec::rows(const BodySpec&, StripOrder order) const {
  constexpr int axis_rows = 64;
  BodyRows rows;
  rows.particles.resize(sim::fish_particles);
  std::iota(rows.particles.begin(), rows.particles.end(), 0);
  if (order == StripOrder::zigzag) rows.weight = sim::fish_axis(axis_rows);
  return rows;
}

const sim::Mesh& FishSpec::particle_mesh(const BodySpec&) const {
  static const sim::Mesh none;
  return none;
}

}  // namespace billow::cli
