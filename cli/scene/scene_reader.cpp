// Scene file -> Scene: the whole file is checked first, then the files it names are opened.
#include <fmt/format.h>

#include <map>

#include "base/error.h"
#include "cli/scene/fingerprint.h"
#include "cli/scene/scene.h"
#include "cli/scene/scene_files.h"
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

/// By which bodies and colliders are told apart.
class Names {
 public:
  /// `kind` is what a message calls a second one of that name.
  void add(const std::string& name, const std::string& where, std::string_view kind) {
    const auto [first, fresh] = first_.try_emplace(name, where);
    if (!fresh) fail_at(where, fmt::format("a second {} named '{}'; the first is at {}", kind, name, first->second));
  }

 private:
  std::map<std::string, std::string> first_;  // where each stands
};

std::string place_of_name(const Node& item) {
  const Entry* given = item.find("name");
  return given ? given->value->where : item.where;
}

std::vector<BodyDraft> read_bodies(MapReader& scene, const std::filesystem::path& folder, Names& names) {
  const Node& node = scene.require("bodies");
  std::vector<BodyDraft> drafts;
  std::vector<NodePtr> records;
  for (const NodePtr& item : read_list(node, "bodies")) {
    records.push_back(make_map());
    drafts.push_back(read_body(*item, static_cast<int>(drafts.size()), folder, records.back()));
    names.add(drafts.back().spec.name, place_of_name(*item), "body");
  }
  if (drafts.empty()) fail_at(node.where, "bodies is empty: a scene needs at least one body");
  scene.record("bodies", make_list(std::move(records)));
  return drafts;
}

std::vector<ColliderDraft> read_colliders(MapReader& scene, const std::filesystem::path& folder, Names& names) {
  std::vector<ColliderDraft> drafts;
  std::vector<NodePtr> records;
  if (const Node* node = scene.find("colliders")) {
    for (const NodePtr& item : read_list(*node, "colliders")) {
      records.push_back(make_map());
      drafts.push_back(read_collider(*item, static_cast<int>(drafts.size()), folder, records.back()));
      names.add(drafts.back().spec.solid.name, place_of_name(*item), "body or collider");
    }
  }
  scene.record("colliders", make_list(std::move(records)));
  return drafts;
}

std::vector<std::string> names_of(const std::vector<BodyDraft>& drafts) {
  std::vector<std::string> names;
  for (const BodyDraft& draft : drafts) names.push_back(draft.spec.name);
  return names;
}

// "-" is standard input.
NodePtr read_root(const std::filesystem::path& file) {
  if (file == "-") return read_yaml_input();
  std::error_code error;
  if (std::filesystem::is_fifo(file, error))
    throw InputError(fmt::format(
        "{}: this is a pipe, not a file; save what comes through it as one, or have 'billow check -' read it "
        "from standard input",
        file.string()));
  return read_yaml_file(file);
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides, const FileWatch& watch) {
  const NodePtr root = with_overrides(read_root(file), overrides);
  const NodePtr record = make_map();
  MapReader map(*root, keys::section(""), record);
  read_version(map);
  Scene scene;
  scene.file = file == "-" ? "<stdin>" : file;
  scene.duration = map.number("duration", scene.duration);
  scene.gravity = map.vector("gravity", scene.gravity);
  Names names;
  std::vector<BodyDraft> drafts = read_bodies(map, file.parent_path(), names);
  std::vector<ColliderDraft> colliders = read_colliders(map, file.parent_path(), names);
  read_water(map, scene);
  scene.wind = read_wind(map);
  scene.solver = read_solver(map, scene.duration);
  const RenderDraft render = read_render(map, scene.duration, names_of(drafts));
  scene.render = render.settings;
  scene.followed = render.followed;
  if (render.ground) names.add(render.ground->name, render.ground_where, "body or collider");
  scene.caches = read_caches(map);
  scene.strip = read_strip(map, scene.duration);
  scene.spectrum = read_spectrum(map, scene.duration, drafts);
  settle_contact(drafts, !colliders.empty() || render.ground);
  scene.effective = to_yaml(*record);
  TextureBudget budget;
  for (BodyDraft& draft : drafts) scene.bodies.push_back(load_body(std::move(draft), watch, budget));
  for (ColliderDraft& draft : colliders) scene.colliders.push_back(load_collider(std::move(draft), watch, budget));
  scene.contact = contact_of(scene, render.ground);
  take_fingerprints(record, scene);
  return scene;
}

}  // namespace billow::cli
