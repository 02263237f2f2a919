// cloth: in a body.
#include <fmt/format.h>

#include <algorithm>

#include "cli/scene/mesh_body.h"
#include "cli/scene/scene_pins.h"

namespace billow::cli {

namespace {

void read_fabric(KindMap& kind, ClothSpec& cloth) {
  const std::string name = kind.map.word("fabric", "none");
  if (name == "none") return;
  cloth.fabric = fabric(name);
  cloth.options.structural = structural_stiffness(*cloth.fabric);
  cloth.options.shear = cloth.fabric->shear;
}

// What the springs follow from, in place of saying them; returns whether it is given.
bool read_material(KindMap& kind, BodyDraft& draft, ClothSpec& cloth) {
  if (kind.map.is_none("material")) return false;
  if (cloth.fabric)
    fail_at(kind.map.where("material"),
            "fabric and material both say what the cloth is made of; leave one of them out");
  refuse_beside_material(kind, "stiffness");
  refuse_beside_material(kind, "buckling_rigidity");
  MapReader map = kind.submap("material");
  const double stretch = map.number("stretch");
  sim::SheetMaterial material{sim::isotropic_membrane(stretch)};
  if (const std::optional<double> shear = map.number_or_word("shear")) {
    material.membrane.shear = *shear;
    draft.shear_where = map.where("shear");
  }
  material.bend = map.number("bend", material.bend);
  cloth.options.material = material;
  return true;
}

// Threads run along the sides of quads.
void check_threads(const sim::Mesh& mesh, const BodyDraft& draft) {
  const bool triangles = std::any_of(mesh.face.begin(), mesh.face.end(),
                                     [](const sim::Face& face) { return sim::corner_count(face) == 3; });
  if (triangles && !draft.shear_where.empty())
    fail_at(
        draft.shear_where,
        "shear is between threads along the sides of quads, and the mesh has triangles; leave it out, and the cloth "
        "is alike in all directions, or make the mesh of quads");
}

// A number into `value`, or the word that leaves it to the fabric, which is the default where there is one. Returns
// whether it is left. Where there is no fabric messages do not speak of it.
bool read_or_leave(MapReader& map, std::string_view key, const ClothSpec& cloth, double& value) {
  if (cloth.fabric) {
    const std::optional<double> given = map.number_or_word(key);
    value = given.value_or(value);
    return !given;
  }
  if (const Node* node = map.find(key)) {
    if (is_word(*node, "fabric"))
      fail_at(map.where(key), fmt::format("{} is left to the fabric, and the cloth has none; give it one, such as "
                                          "'fabric: cotton', or a number here",
                                          key));
    value = read_number(*node, key, map.key(key).range);
  }
  map.record(key, record_of(value));
  return false;
}

void read_stiffness(KindMap& kind, ClothSpec& cloth) {
  MapReader map = kind.submap("stiffness");
  cloth.options.structural = map.number("structural", cloth.options.structural);
  cloth.options.shear = map.number("shear", cloth.options.shear);
  cloth.bend_of_fabric = read_or_leave(map, "bend", cloth, cloth.options.bend);
  cloth.max_eigenvalue = map.number_or_word("max_eigenvalue");
}

}  // namespace

void read_cloth(MapReader& body, const std::filesystem::path& folder, BodyDraft& draft) {
  KindMap kind = kind_map(body, "cloth");
  ClothSpec cloth;
  cloth.options.name = draft.spec.name;
  read_mesh(kind, folder, draft);
  read_fabric(kind, cloth);
  if (!read_density(kind, cloth)) cloth.mass_of_fabric = read_or_leave(kind.map, "mass", cloth, cloth.options.mass);
  read_mass_distribution(kind, cloth.options);
  cloth.options.spring_model = kind.map.choice("model", cloth.options.spring_model);
  if (!read_material(kind, draft, cloth)) {
    read_stiffness(kind, cloth);
    cloth.buckling_of_fabric = read_or_leave(kind.map, "buckling_rigidity", cloth, cloth.options.buckling_rigidity);
  }
  cloth.strain_limit = kind.map.number_or_word("strain_limit");
  read_damping(kind, cloth.options);
  read_start(kind, draft);
  draft.spec.kind = std::move(cloth);
}

ContactSpec ClothSpec::contact_by_kind() const {
  ContactSpec contact{.self = true};
  if (fabric) contact.thickness = fabric->thickness, contact.friction = fabric->friction;
  return contact;
}

void ClothSpec::place(const sim::Mesh& mesh, const BodyDraft& draft, BodySpec& body) {
  body.mesh = placed(mesh, draft);
  body.pins = placed_pins(body.mesh, draft);
  options.pinned = held_vertices(body.pins, 0.0);
  if (density) options.mass = *density * sim::area(body.mesh);
  check_threads(body.mesh, draft);
  const double edge = sim::mean_edge_length(body.mesh);
  if (options.material) options.buckling_rigidity = beam_rigidity(options.material->bend, edge);
  if (!fabric) return;
  if (mass_of_fabric) options.mass = fabric->area_density * sim::area(body.mesh);
  if (bend_of_fabric) options.bend = bend_stiffness(*fabric, edge);
  if (buckling_of_fabric) options.buckling_rigidity = beam_rigidity(fabric->bend, edge);
}

sim::Structure ClothSpec::build(const BodySpec& body) const {
  return scaled(sim::build_cloth(body.mesh, options), *this);
}

}  // namespace billow::cli
