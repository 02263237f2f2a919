// The files that a body names: its mesh, where its pins are, and its texture.
#include <fmt/format.h>

#include <algorithm>

#include "cli/scene_parts.h"
#include "render/png.h"
#include "sim/error.h"
#include "sim/mesh_import.h"

namespace billow::cli {
namespace {

namespace fs = std::filesystem;

// Runs `work` and puts the place in the scene before whatever it finds wrong.
template <class Work>
auto located(const std::string& where, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    fail_at(where, error.what());
  }
}

void check_file(const fs::path& file, std::string_view kind, const std::string& where) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  const std::string shown = file.lexically_normal().string();
  if (status.type() == fs::file_type::not_found) fail_at(where, fmt::format("there is no {} file {}", kind, shown));
  if (!fs::is_regular_file(status)) fail_at(where, fmt::format("the {} {} is not a regular file", kind, shown));
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
    fail_at(draft.pins_where, "the pins hold every vertex, so nothing of the cloth can move");
  return pinned;
}

}  // namespace

BodySpec load_body(BodyDraft draft) {
  BodySpec& spec = draft.spec;
  if (!spec.mesh_file.empty()) check_file(spec.mesh_file, "mesh", spec.mesh_where);
  if (!spec.texture_file.empty()) {
    check_file(spec.texture_file, "texture", draft.texture_where);
    spec.texture = located(draft.texture_where, [&] { return render::read_png(spec.texture_file); });
  }
  if (spec.mesh_file.empty()) return std::move(spec);
  const sim::Mesh mesh = located(spec.mesh_where, [&] { return sim::import_mesh(spec.mesh_file); });
  if (spec.fish) return spec.mesh = mesh, std::move(spec);
  spec.mesh = sim::transformed(mesh, draft.rotation, draft.scale, draft.translation);
  spec.cloth.pinned = pinned_vertices(spec.mesh, draft);
  return std::move(spec);
}

sim::Structure build_structure(const Scene& scene) {
  std::vector<sim::Structure> parts;
  for (const BodySpec& body : scene.bodies)
    parts.push_back(located(body.mesh_where, [&] {
      return body.fish ? sim::build_fish(body.fish->options) : sim::build_cloth(body.mesh, body.cloth);
    }));
  return sim::merge(parts);
}

}  // namespace billow::cli
