// The files that a body names: its mesh and its texture.
#include "cli/scene/mesh_warnings.h"
#include "cli/scene/scene_files.h"
#include "cli/scene/scene_parts.h"

namespace billow::cli {

BodySpec load_body(BodyDraft draft, const FileWatch& watch, TextureBudget& budget) {
  BodySpec& spec = draft.spec;
  check_file(spec.mesh_file, "mesh", spec.mesh_where);
  sim::Mesh mesh;
  if (!spec.mesh_file.empty()) mesh = load_mesh(spec.mesh_file, spec.mesh_where, watch);
  load_look(spec, mesh, spec.mesh_file, watch, budget);
  if (!spec.mesh_file.empty()) place_mesh(mesh, draft, spec);
  spec.warnings = mesh_warnings(spec, draft.unit_given);
  spec.framed_points = framed_vertices(spec);
  return std::move(spec);
}

sim::Structure build_structure(const Scene& scene) {
  std::vector<sim::Structure> parts;
  for (const BodySpec& body : scene.bodies) parts.push_back(located(body.mesh_where, [&] { return build_body(body); }));
  return sim::merge(parts);
}

}  // namespace billow::cli
