// soft: in a body.
#include <fmt/format.h>

#include <climits>
#include <cmath>

#include "cli/scene/mesh_body.h"
#include "cli/scene/particle_expression.h"
#include "cli/scene/scene_pins.h"
#include "sim/mesh/boundary.h"
#include "sim/mesh/closed_surface.h"

namespace billow::cli {

namespace {

void read_stiffness(KindMap& kind, SoftSpec& soft) {
  MapReader map = kind.submap("stiffness");
  read_surface_springs(map, soft.options.surface);
  soft.options.interior = map.number("interior", soft.options.interior);
  soft.max_eigenvalue = map.number_or_word("max_eigenvalue");
}

bool read_material(KindMap& kind, SoftSpec& soft) {
  if (kind.map.is_none("material")) return false;
  refuse_beside_material(kind, "stiffness");
  soft.options.young = kind.submap("material").number("young");
  return true;
}

FormulaDraft read_formula(MapReader& map, std::string_view key) {
  return {map.text(key, FormulaDraft{}.text), map.where(key)};
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

}  // namespace

void read_soft(MapReader& body, const std::filesystem::path& folder, BodyDraft& draft) {
  KindMap kind = kind_map(body, "soft");
  SoftSpec soft;
  soft.options.surface.name = draft.spec.name;
  read_mesh(kind, folder, draft);
  soft.close_holes = kind.map.boolean("close_holes", soft.close_holes);
  if (read_density(kind, soft))
    read_mass_distribution(kind, soft.options.surface);
  else
    read_mass(kind, soft.options.surface);
  if (!read_material(kind, soft)) read_stiffness(kind, soft);
  MapReader variation = kind.submap("variation");
  draft.stiffness_factor = read_formula(variation, "stiffness");
  draft.mass_factor = read_formula(variation, "mass");
  read_damping(kind, soft.options.surface);
  read_start(kind, draft);
  draft.spec.kind = std::move(soft);
}

// Its springs keep it from folding onto itself.
ContactSpec SoftSpec::contact_by_kind() const { return {.self = false}; }

void SoftSpec::place(const sim::Mesh& mesh, const BodyDraft& draft, BodySpec& body) {
  body.mesh = placed(close_holes ? sim::with_holes_closed(mesh, INT_MAX) : mesh, draft);
  body.pins = placed_pins(body.mesh, draft);
  if (density) options.surface.mass = *density * std::abs(sim::enclosed_volume(body.mesh));
  options.surface.pinned = held_vertices(body.pins, 0.0);
  options.stiffness_factor = factors(body.mesh, draft.stiffness_factor, "the variation of stiffness");
  options.mass_factor = factors(body.mesh, draft.mass_factor, "the variation of mass");
}

sim::Structure SoftSpec::build(const BodySpec& body) const {
  return scaled(sim::build_soft_body(body.mesh, options), *this);
}

}  // namespace billow::cli
