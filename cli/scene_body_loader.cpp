// The files that a body names: its mesh, what the scene says of the mesh's vertices, and its texture.
#include <fmt/format.h>

#include <algorithm>

#include "cli/particle_expression.h"
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
    fail_at(draft.pins_where, "the pins hold every vertex, so nothing of the body can move");
  return pinned;
}

// Positive factors (v), one per vertex; none for the constant 1.
Eigen::VectorXd factors(const sim::Mesh& mesh, const FormulaDraft& formula, std::string_view name) {
  if (formula.text == FormulaDraft{}.text) return {};
  const Eigen::VectorXd value =
      located(formula.where, [&] { return evaluate_at_particles(formula.text, mesh.position, mesh); });
  for (Eigen::Index v = 0; v < value.size(); ++v)
    if (!(value(v) > 0.0))
      fail_at(formula.where,
              fmt::format("{} must be above 0 everywhere; at vertex {} ({:.4g}, {:.4g}, {:.4g}) it is "
                          "{:.4g}",
                          name, v, mesh.position(v, 0), mesh.position(v, 1), mesh.position(v, 2), value(v)));
  return value;
}

void find_material(const BodyDraft& draft, const sim::Mesh& mesh, sim::SoftBodyOptions& soft) {
  soft.stiffness_factor = factors(mesh, draft.stiffness_factor, "the variation of stiffness");
  soft.mass_factor = factors(mesh, draft.mass_factor, "the variation of mass");
}

sim::Structure build_body(const BodySpec& body) {
  if (body.fish) return sim::build_fish(body.fish->options);
  return body.soft ? sim::build_soft_body(body.mesh, *body.soft) : sim::build_cloth(body.mesh, body.cloth);
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
  (spec.soft ? spec.soft->surface : spec.cloth).pinned = pinned_vertices(spec.mesh, draft);
  if (spec.soft) find_material(draft, spec.mesh, *spec.soft);
  return std::move(spec);
}

sim::Structure build_structure(const Scene& scene) {
  std::vector<sim::Structure> parts;
  for (const BodySpec& body : scene.bodies) parts.push_back(located(body.mesh_where, [&] { return build_body(body); }));
  return sim::merge(parts);
}

}  // namespace billow::cli
