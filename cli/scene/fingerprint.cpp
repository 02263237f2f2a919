// Hashes over the record of a scene and the files that it names.
#include "cli/scene/fingerprint.h"

#include <algorithm>
#include <initializer_list>

#include "cli/scene/hash.h"

namespace billow::cli {

namespace {

template <class Value>
std::string_view bytes_of(const Value* values, std::size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof(Value)};
}

// The geometry goes in beside the mesh file's bytes, because a glTF keeps it in a second file.
void add_mesh(Hash& hash, const std::filesystem::path& mesh_file, const sim::Mesh& mesh) {
  if (!mesh_file.empty()) hash.add_file(mesh_file);
  hash.add(bytes_of(mesh.position.data(), static_cast<std::size_t>(mesh.position.size())));
  hash.add(bytes_of(mesh.face.data(), mesh.face.size()));
}

// Materials may stand in a file beside the mesh's.
void add_finish(Hash& hash, const render::Finish& finish) {
  const float numbers[] = {finish.colour.x(), finish.colour.y(), finish.colour.z(),
                           finish.opacity,    finish.cutoff,     static_cast<float>(finish.alpha)};
  hash.add(bytes_of(numbers, std::size(numbers)));
  hash.add(bytes_of(finish.texture.pixels.data(), finish.texture.pixels.size()));
}

using Keys = std::initializer_list<std::string_view>;

bool among(std::string_view key, const Keys& keys) { return std::find(keys.begin(), keys.end(), key) != keys.end(); }

NodePtr without(const NodePtr& map, const Keys& keys) {
  if (map->kind != Node::Kind::map) return map;
  auto rest = std::make_shared<Node>(*map);
  std::erase_if(rest->entries, [&](const Entry& entry) { return among(entry.key, keys); });
  return rest;
}

NodePtr with_only(const NodePtr& map, const Keys& keys) {
  auto rest = std::make_shared<Node>(*map);
  std::erase_if(rest->entries, [&](const Entry& entry) { return !among(entry.key, keys); });
  return rest;
}

NodePtr each_without(const NodePtr& list, const Keys& keys) {
  auto rest = std::make_shared<Node>(*list);
  for (NodePtr& item : rest->items) item = without(item, keys);
  return rest;
}

// What of the record moves anything, and when frames are taken of it. A ground that collides is in `render`.
NodePtr motion_of(const NodePtr& effective) {
  const NodePtr motion = without(effective, {"duration", "caches", "strip", "spectrum"});
  for (Entry& entry : motion->entries) {
    if (among(entry.key, {"bodies", "colliders"}))
      entry.value = each_without(entry.value, {"texture", "colour", "alpha"});
    if (entry.key == "water") entry.value = without(entry.value, {"motes"});
    if (entry.key != "render") continue;
    const Entry* ground = entry.value->find("ground");
    const bool collides = ground && ground->value->kind == Node::Kind::map;
    entry.value = collides ? with_only(entry.value, {"fps", "ground"}) : with_only(entry.value, {"fps"});
  }
  return motion;
}

std::string hash_of(const Scene& scene, const std::string& record, bool looks) {
  Hash hash;
  hash.add(record);
  const auto add = [&](const std::filesystem::path& mesh_file, const sim::Mesh& mesh, const Look& look) {
    add_mesh(hash, mesh_file, mesh);
    if (looks && !look.texture_file.empty()) hash.add_file(look.texture_file);
    if (looks && look.texture_file.empty())
      for (const render::Finish& finish : look.finish) add_finish(hash, finish);
  };
  for (const BodySpec& body : scene.bodies) add(body.mesh_file, body.mesh, body);
  for (const ColliderSpec& collider : scene.colliders) add(collider.mesh_file, collider.solid.mesh, collider);
  return hash.hex();
}

}  // namespace

void take_fingerprints(const NodePtr& effective, Scene& scene) {
  scene.hash = hash_of(scene, scene.effective, true);
  scene.timeless_hash = hash_of(scene, to_yaml(*without(effective, {"duration"})), true);
  scene.motion_hash = hash_of(scene, to_yaml(*motion_of(effective)), false);
}

}  // namespace billow::cli
