// cloth: in a body.
#include "cli/scene/mesh_body.h"

namespace billow::cli {

namespace {

void read_stiffness(KindMap& kind, ClothSpec& cloth) {
  MapReader map = kind.submap("stiffness");
  read_surface_springs(map, cloth.options);
  cloth.max_eigenvalue = map.number_or_word("max_eigenvalue");
}

}  // namespace

void read_cloth(MapReader& body, const std::filesystem::path& folder, BodyDraft& draft) {
  KindMap kind = kind_map(body, "cloth");
  ClothSpec cloth;
  cloth.options.name = draft.spec.name;
  read_mesh(kind, folder, draft);
  read_mass(kind, cloth.options);
  cloth.options.spring_model = kind.map.choice("model", cloth.options.spring_model);
  read_stiffness(kind, cloth);
  cloth.options.buckling_rigidity = kind.map.number("buckling_rigidity", cloth.options.buckling_rigidity);
  read_damping(kind, cloth.options);
  read_start(kind, draft);
  draft.spec.kind = std::move(cloth);
}

void ClothSpec::place(const sim::Mesh& mesh, const BodyDraft& draft, BodySpec& body) {
  body.mesh = placed(mesh, draft);
  options.pinned = pinned_vertices(body.mesh, draft);
}

sim::Structure ClothSpec::build(const BodySpec& body) const {
  return scaled(sim::build_cloth(body.mesh, options), *this);
}

}  // namespace billow::cli
