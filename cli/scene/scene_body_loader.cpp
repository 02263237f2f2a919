// The files that a body names: its mesh and its texture.
#include <fmt/format.h>

#include "cli/scene/scene_parts.h"
#include "render/image/png.h"
#include "sim/mesh/mesh_import.h"

namespace billow::cli {
namespace {

namespace fs = std::filesystem;

void check_file(const fs::path& file, std::string_view kind, const std::string& where) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  const std::string shown = file.lexically_normal().string();
  if (status.type() == fs::file_type::not_found) fail_at(where, fmt::format("there is no {} file {}", kind, shown));
  if (!fs::is_regular_file(status)) fail_at(where, fmt::format("the {} {} is not a regular file", kind, shown));
}

}  // namespace

BodySpec load_body(BodyDraft draft, const FileWatch& watch) {
  BodySpec& spec = draft.spec;
  const auto tell = [&](const fs::path& file) {
    if (watch) watch(file);
  };
  if (!spec.mesh_file.empty()) check_file(spec.mesh_file, "mesh", spec.mesh_where);
  if (!spec.texture_file.empty()) {
    check_file(spec.texture_file, "texture", draft.texture_where);
    tell(spec.texture_file);
    spec.texture = located(draft.texture_where, [&] { return render::read_png(spec.texture_file); });
  }
  if (!spec.mesh_file.empty()) {
    tell(spec.mesh_file);
    place_mesh(located(spec.mesh_where, [&] { return sim::import_mesh(spec.mesh_file); }), draft, spec);
  }
  return std::move(spec);
}

sim::Structure build_structure(const Scene& scene) {
  std::vector<sim::Structure> parts;
  for (const BodySpec& body : scene.bodies) parts.push_back(located(body.mesh_where, [&] { return build_body(body); }));
  return sim::merge(parts);
}

}  // namespace billow::cli
