// Scene file -> Scene: the whole file is checked first, then the files it names are opened.
#include <fmt/format.h>

#include <map>

#include "cli/scene/hash.h"
#include "cli/scene/scene.h"
#include "cli/scene/scene_keys.h"
#include "cli/scene/scene_parts.h"
#include "cli/text/number_text.h"

namespace billow::cli {
namespace {

constexpr int format_version = 1;

void read_version(MapReader& map) {
  const Node& node = map.require("billow", "; begin it with 'billow: 1'");
  if (node.quoted || !is_word(node, std::to_string(format_version)))
    fail_at(node.where, fmt::format("billow, the version of the scene format, must be {0}: this billow reads version "
                                    "{0} only",
                                    format_version));
  map.integer("billow");
}

std::vector<BodyDraft> read_bodies(MapReader& scene, const std::filesystem::path& folder) {
  const Node& node = scene.require("bodies");
  std::vector<BodyDraft> drafts;
  std::vector<NodePtr> records;
  std::map<std::string, std::string> first_place;
  for (const NodePtr& item : read_list(node, "bodies")) {
    records.push_back(make_map());
    drafts.push_back(read_body(*item, static_cast<int>(drafts.size()), folder, records.back()));
    const std::string& name = drafts.back().spec.name;
    const Entry* given = item->find("name");
    const auto [first, fresh] = first_place.try_emplace(name, given ? given->value->where : item->where);
    if (!fresh)
      fail_at(given ? given->value->where : item->where,
              fmt::format("a second body named '{}'; the first is at {}", name, first->second));
  }
  if (drafts.empty()) fail_at(node.where, "bodies is empty: a scene needs at least one body");
  scene.record("bodies", make_list(std::move(records)));
  return drafts;
}

std::vector<std::string> names_of(const std::vector<BodyDraft>& drafts) {
  std::vector<std::string> names;
  for (const BodyDraft& draft : drafts) names.push_back(draft.spec.name);
  return names;
}

template <class Value>
std::string_view bytes_of(const Value* values, std::size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof(Value)};
}

// The geometry goes in beside the mesh file's bytes, because a glTF keeps it in a second file.
std::string fingerprint(const Scene& scene) {
  Hash hash;
  hash.add(scene.effective);
  for (const BodySpec& body : scene.bodies) {
    if (!body.mesh_file.empty()) hash.add_file(body.mesh_file);
    hash.add(bytes_of(body.mesh.position.data(), static_cast<std::size_t>(body.mesh.position.size())));
    hash.add(bytes_of(body.mesh.face.data(), body.mesh.face.size()));
    if (!body.texture_file.empty()) hash.add_file(body.texture_file);
  }
  return hash.hex();
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides, const FileWatch& watch) {
  const NodePtr root = with_overrides(read_yaml_file(file), overrides);
  const NodePtr record = make_map();
  MapReader map(*root, keys::section(""), record);
  read_version(map);
  Scene scene;
  scene.file = file;
  scene.duration = map.number("duration", scene.duration);
  scene.gravity = map.vector("gravity", scene.gravity);
  std::vector<BodyDraft> drafts = read_bodies(map, file.parent_path());
  read_water(map, scene);
  scene.solver = read_solver(map, scene.duration);
  scene.render = read_render(map, scene.duration, names_of(drafts), scene.followed);
  scene.strip = read_strip(map, scene.duration);
  scene.spectrum = read_spectrum(map, scene.duration, drafts);
  scene.effective = to_yaml(*record);
  for (BodyDraft& draft : drafts) scene.bodies.push_back(load_body(std::move(draft), watch));
  scene.hash = fingerprint(scene);
  return scene;
}

}  // namespace billow::cli
