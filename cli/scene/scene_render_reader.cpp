// render: and strip: in a scene: frames, camera and colours.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "base/suggest.h"
#include "cli/scene/scene_keys.h"
#include "cli/scene/scene_parts.h"
#include "cli/text/number_text.h"
#include "cli/yaml/colour_text.h"
#include "render/image/camera_motion.h"

namespace billow::cli {
namespace {

constexpr double default_fov = 40.0;  // [degrees]
constexpr double max_frames = 1e6;
constexpr double max_strip_columns = 1e6;

void read_size(MapReader& map, render::Settings& settings) {
  if (const Node* node = map.find("size")) {
    if (node->kind != Node::Kind::list || node->items.size() != 2)
      fail_at(node->where, "size must be a list [width, height]");
    const Range& range = map.key("size").range;
    settings.width = read_integer(*node->items[0], "width", range);
    settings.height = read_integer(*node->items[1], "height", range);
  }
  const auto number = [](int value) { return make_scalar(std::to_string(value)); };
  map.record("size", make_list({number(settings.width), number(settings.height)}));
}

int read_samples(MapReader& map, int fallback) {
  return static_cast<int>(parse_number(map.word("samples", std::to_string(fallback))).value);
}

void read_views(MapReader& map, std::vector<render::View>& views) {
  if (const Node* node = map.find("views")) {
    views.clear();
    for (const NodePtr& item : read_list(*node, "views")) {
      const auto view = read_choice<render::View>(*item, "view");
      if (std::find(views.begin(), views.end(), view) != views.end())
        fail_at(item->where, fmt::format("the view '{}' is listed twice", item->text));
      views.push_back(view);
    }
    if (views.empty()) fail_at(node->where, "views is empty: list at least one, such as textured");
  }
  std::vector<NodePtr> record;
  for (const render::View view : views) record.push_back(make_scalar(std::string(word_of(view))));
  map.record("views", make_list(std::move(record)));
}

// The point under `key`, or nothing when it is to be fitted.
std::optional<Eigen::Vector3d> read_camera_point(MapReader& map, std::string_view key) {
  const Node* node = map.find(key);
  if (node && !is_word(*node, "fit")) return map.vector(key, Eigen::Vector3d::Zero());
  map.record(key, make_scalar("fit"));
  return std::nullopt;
}

void read_camera_keys(MapReader& map, render::Camera& camera) {
  const auto eye = read_camera_point(map, "eye"), look_at = read_camera_point(map, "look_at");
  camera.vertical_fov = map.number("fov", default_fov) * std::numbers::pi / 180.0;
  camera.fitted = !eye;
  if (eye.has_value() != look_at.has_value())
    fail_at(map.where(), "camera needs both eye and look_at, or neither to be fitted");
  if (!eye) return;
  if ((*eye - *look_at).norm() < 1e-9) fail_at(map.where("look_at"), "look_at is where the eye is");
  camera.eye = *eye;
  camera.look_at = *look_at;
}

render::CameraKey read_camera_key(const Node& node, double fov, const NodePtr& record) {
  MapReader map(node, keys::section("render.camera.keys[]"), record);
  render::CameraKey key;
  key.time = map.number("time");
  map.require("eye"), map.require("look_at");
  key.eye = map.vector("eye", {}), key.look_at = map.vector("look_at", {});
  key.vertical_fov = map.number("fov", fov) * std::numbers::pi / 180.0;
  return key;
}

// Between keys the eye may come to what it looks at, and then there is no direction to look in.
void check_way(const render::Camera& camera, const std::string& where) {
  for (const render::Camera& moment : render::cameras_along(camera))
    if ((moment.eye - moment.look_at).norm() < 1e-9)
      fail_at(where, "on its way the camera's eye comes to what it looks at; add a key that leads around it");
}

void read_camera_path(MapReader& map, double fov, render::Camera& camera) {
  std::vector<NodePtr> record;
  if (const Node* node = map.find("keys"))
    for (const NodePtr& item : read_list(*node, "keys")) {
      record.push_back(make_map());
      camera.keys.push_back(read_camera_key(*item, fov, record.back()));
      const std::size_t count = camera.keys.size();
      if (count > 1 && !(camera.keys[count - 1].time > camera.keys[count - 2].time))
        fail_at(item->where,
                fmt::format("keys[{}] is no later than the one before it; sort the keys by time", count - 1));
    }
  map.record("keys", make_list(std::move(record)));
  camera.turn_period = map.number_or_word("turntable").value_or(0.0);
  if (camera.keys.empty()) return;
  if (!camera.fitted) fail_at(map.where("keys"), "with keys, which say where the camera is, leave out eye and look_at");
  camera.fitted = false;
  check_way(camera, map.where("keys"));
}

// The place of the body that the camera stays beside.
std::optional<int> read_follow(MapReader& camera, const std::vector<std::string>& bodies) {
  const std::string name = camera.text("follow", "none");
  const auto found = std::find(bodies.begin(), bodies.end(), name);
  if (found != bodies.end()) return static_cast<int>(found - bodies.begin());
  if (name == "none") return std::nullopt;
  fail_at(camera.where("follow"), fmt::format("there is no body '{}' to follow{}", name,
                                              suggestion(name, {bodies.begin(), bodies.end()}, "the scene has")));
}

// `camera: fit` is short for a camera without keys.
std::optional<int> read_camera(MapReader& map, render::Camera& camera, const std::vector<std::string>& bodies) {
  const Node* node = map.find("camera");
  if (node && is_word(*node, "fit")) node = nullptr;
  MapReader camera_map = map.map_from(node, "camera", keys::section("render.camera"));
  read_camera_keys(camera_map, camera);
  read_camera_path(camera_map, camera.vertical_fov * 180.0 / std::numbers::pi, camera);
  return read_follow(camera_map, bodies);
}

// A ground that collides: bodies must know where it is before they have moved.
sim::Collider read_colliding_ground(MapReader& ground) {
  ground.require("height", ": it says where bodies land");
  sim::Collider collider;
  collider.name = "ground";
  collider.half_space.emplace().point.y() = ground.number("height");
  ground.boolean("collide", true);
  collider.thickness = ground.number("thickness", collider.thickness);
  collider.friction = ground.number("friction", collider.friction);
  return collider;
}

// A ground that does not collide, as short as a scene can write it.
NodePtr record_of_ground(const render::Settings& settings) {
  const NodePtr height = settings.ground_height ? record_of(*settings.ground_height) : nullptr;
  if (!settings.shadow_only) return height ? height : make_scalar("true");
  if (!height) return make_scalar("shadow_only");
  const NodePtr record = make_map();
  record->entries = {{"height", {}, height}, {"shadow_only", {}, make_scalar("true")}};
  return record;
}

// A map of keys. Without collision only the height and what is drawn matter.
std::optional<sim::Collider> read_ground_map(MapReader& map, const Node& node, render::Settings& settings) {
  const Section& section = keys::section("render.ground");
  settings.ground = true;
  MapReader plain(node, section, make_map());
  settings.shadow_only = plain.boolean("shadow_only", false);
  if (!plain.boolean("collide", false)) {
    if (plain.find("height")) settings.ground_height = plain.number("height");
    map.record("ground", record_of_ground(settings));
    return std::nullopt;
  }
  MapReader ground = map.map_from(&node, "ground", section);
  const sim::Collider collider = read_colliding_ground(ground);
  ground.boolean("shadow_only", false);
  settings.ground_height = collider.half_space->point.y();
  return collider;
}

// true, false, the height of the ground, or a map with keys. The collider, where it collides.
std::optional<sim::Collider> read_ground(MapReader& map, render::Settings& settings) {
  const Node* node = map.find("ground");
  if (node && node->kind == Node::Kind::map) return read_ground_map(map, *node, settings);
  if (!node || is_word(*node, "true") || is_word(*node, "false")) {
    settings.ground = map.boolean("ground", settings.ground);
    return std::nullopt;
  }
  if (is_word(*node, "shadow_only")) {
    settings.ground = settings.shadow_only = true;
    map.record("ground", make_scalar("shadow_only"));
    return std::nullopt;
  }
  settings.ground = true;
  settings.ground_height = map.number("ground");
  return std::nullopt;
}

// One colour is short for the same colour at top and bottom; `none` leaves pictures transparent.
void read_background(MapReader& map, render::Background& background) {
  if (const Node* node = map.find("background"); node && is_word(*node, "none")) {
    background.none = true;
    map.record("background", make_scalar("none"));
    return;
  }
  const Node* node = map.find("background", "; a colour that begins with # needs quotes");
  Node both = *make_map();
  if (node && node->kind != Node::Kind::map) {
    read_colour(*node, "background");
    for (const char* end : {"top", "bottom"}) both.entries.push_back({end, {}, std::make_shared<Node>(*node)});
    node = &both;
  }
  MapReader ends = map.map_from(node, "background", keys::section("render.background"));
  background.top = read_colour(ends, "top", background.top);
  background.bottom = read_colour(ends, "bottom", background.bottom);
}

}  // namespace

RenderDraft read_render(MapReader& scene, double duration, const std::vector<std::string>& bodies) {
  MapReader map = scene.map("render", keys::section("render"));
  RenderDraft draft;
  render::Settings& settings = draft.settings;
  read_size(map, settings);
  settings.fps = map.number("fps", settings.fps);
  if (duration * settings.fps > max_frames)
    fail_at(map.where("fps"), fmt::format("{} s at {} frames per second are more than 1,000,000 frames",
                                          shortest(duration), shortest(settings.fps)));
  settings.samples = read_samples(map, settings.samples);
  read_views(map, settings.views);
  draft.followed = read_camera(map, settings.camera, bodies);
  draft.ground = read_ground(map, settings);
  draft.ground_where = map.where("ground");
  settings.velocity_colour = map.choice("velocity_colour", settings.velocity_colour);
  settings.velocity_range = map.number_or_word("velocity_range");
  settings.velocity_shading = map.number("velocity_shading", settings.velocity_shading);
  settings.legend = map.boolean("legend", settings.legend);
  read_background(map, settings.background);
  if (settings.shadow_only && !settings.background.none)
    fail_at(draft.ground_where, "a ground that is shadow_only needs 'background: none', before which it lies");
  return draft;
}

std::optional<StripSpec> read_strip(MapReader& scene, double duration) {
  if (scene.is_none("strip")) return std::nullopt;
  MapReader map = scene.map("strip", keys::section("strip"));
  StripSpec strip;
  strip.step = map.number("step", strip.step);
  if (duration / strip.step > max_strip_columns)
    fail_at(map.where("step"), fmt::format("a column every {} s of {} s are more than 1,000,000 columns",
                                           shortest(strip.step), shortest(duration)));
  strip.order = map.choice("order", strip.order);
  return strip;
}

}  // namespace billow::cli
