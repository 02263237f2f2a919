// Mesh -> Structure: masses, springs with their material, pins.
#include "sim/body/cloth.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "sim/body/bending_springs.h"
#include "sim/body/cloth_springs.h"
#include "sim/body/needed_springs.h"
#include "sim/mesh/regular_values.h"

namespace billow::sim {
namespace {

// Half the cross product of the diagonals: the exact area of a flat quad, the projected one of a bent quad.
double area(const Mesh& mesh, const Face& face) {
  const auto corner = [&](int c) -> Eigen::Vector3d { return mesh.position.row(face[c]); };
  const Eigen::Vector3d across = corner_count(face) == 4 ? corner(3) - corner(1) : corner(2) - corner(1);
  const Eigen::Vector3d along = corner_count(face) == 4 ? corner(2) - corner(0) : corner(1) - corner(0);
  return 0.5 * along.cross(across).norm();
}

// Each face's area in equal shares to its corners [m^2] (v).
Eigen::VectorXd vertex_areas(const Mesh& mesh) {
  Eigen::VectorXd share = Eigen::VectorXd::Zero(mesh.vertices());
  for (const Face& face : mesh.face) {
    const int corners = corner_count(face);
    for (int c = 0; c < corners; ++c) share(face[c]) += area(mesh, face) / corners;
  }
  return share;
}

Eigen::VectorXd masses(const Mesh& mesh, const ClothOptions& options) {
  Eigen::VectorXd share = options.mass_by_area ? vertex_areas(mesh) : Eigen::VectorXd::Ones(mesh.vertices()).eval();
  for (Eigen::Index v = 0; v < share.size(); ++v)
    if (!(share(v) > 0.0))
      throw InputError(
          "vertex " + std::to_string(v) +
          " would have no mass, because its faces have no area; repair the mesh or spread the mass evenly");
  make_regular(share);
  return share * (options.mass / share.sum());
}

double stiffness_of(SpringKind kind, const ClothOptions& options) {
  if (kind == SpringKind::structural) return options.structural;
  return kind == SpringKind::shear ? options.shear : options.bend;
}

// Choi and Ko's cloth bends along diagonals as well, and so does a material, alike in all directions.
BendLines bend_lines(const ClothOptions& options) {
  const bool material_bends = options.material && options.material->bend > 0.0;
  return options.spring_model == SpringModel::choi_ko || material_bends ? BendLines::edges_and_diagonals
                                                                        : BendLines::edges;
}

// A spring that carries a tension at rest is that much shorter than it lies, and one that pushes longer: by this share
// of its length at most, or else it is made stiffer.
constexpr double most_strained_at_rest = 0.1;

// Tensions at rest per length, as stiffnesses and rest lengths.
void strain(const Eigen::VectorXd& force_density, Structure& cloth) {
  for (int s = 0; s < cloth.springs(); ++s) {
    cloth.stiffness(s) = std::max(cloth.stiffness(s), std::abs(force_density(s)) / most_strained_at_rest);
    if (cloth.stiffness(s) > 0.0) cloth.rest_length(s) *= 1.0 - force_density(s) / cloth.stiffness(s);
  }
}

void make_of(const SheetMaterial& material, const Mesh& mesh, const ClothOptions& options,
             const std::vector<SpringPair>& pairs, Structure& cloth) {
  cloth.stiffness = membrane_stiffness(mesh, pairs, material.membrane);
  if (options.spring_model == SpringModel::choi_ko) {
    for (int s = 0; s < cloth.springs(); ++s)
      if (cloth.kind[s] == SpringKind::bend) cloth.stiffness(s) = edge_stiffness(material.membrane);
  } else if (material.bend > 0.0) {
    strain(bending_force_density(mesh, pairs, material.bend), cloth);
  }
  make_regular(cloth.stiffness);
  make_regular(cloth.rest_length);
}

void add_springs(const Mesh& mesh, const ClothOptions& options, Structure& cloth) {
  const std::vector<SpringPair> pairs = cloth_springs(mesh, bend_lines(options));
  const Eigen::Index m = static_cast<Eigen::Index>(pairs.size());
  cloth.spring.resize(m, 2);
  cloth.rest_length.resize(m);
  cloth.stiffness.resize(m);
  cloth.damping = Eigen::VectorXd::Constant(m, options.damping);
  cloth.kind.resize(m);
  for (Eigen::Index s = 0; s < m; ++s) {
    const auto& [kind, first, second] = pairs[s];
    cloth.spring.row(s) << first, second;
    cloth.rest_length(s) = (mesh.position.row(second) - mesh.position.row(first)).norm();
    cloth.stiffness(s) = stiffness_of(kind, options);
    cloth.kind[s] = kind;
    if (!(cloth.rest_length(s) > 0.0))
      throw InputError("vertices " + std::to_string(first) + " and " + std::to_string(second) +
                       " are joined but lie at the same place; repair the mesh");
  }
  make_regular(cloth.rest_length);
  if (options.material) make_of(*options.material, mesh, options, pairs, cloth);
}

void pin(const std::vector<int>& vertices, Structure& cloth) {
  for (const int v : vertices) {
    if (v < 0 || v >= cloth.particles())
      throw InputError("cannot pin vertex " + std::to_string(v) + ": the mesh has vertices 0 to " +
                       std::to_string(cloth.particles() - 1));
    cloth.inverse_mass(v) = 0.0;
  }
}

double mean_structural_length(const Structure& cloth) {
  double sum = 0.0;
  int count = 0;
  for (int s = 0; s < cloth.springs(); ++s) {
    if (cloth.kind[s] != SpringKind::structural) continue;
    sum += cloth.rest_length(s);
    ++count;
  }
  return sum / count;
}

}  // namespace

double area(const Mesh& mesh) { return vertex_areas(mesh).sum(); }

Structure build_cloth(const Mesh& mesh, const ClothOptions& options) {
  Structure cloth;
  cloth.rest_position = mesh.position;
  cloth.mass = masses(mesh, options);
  cloth.inverse_mass = cloth.mass.cwiseInverse();
  add_springs(mesh, options, cloth);
  pin(options.pinned, cloth);
  cloth.body = {{.name = options.name,
                 .particles = cloth.particles(),
                 .springs = cloth.springs(),
                 .spring_model = options.spring_model,
                 .damping_model = options.damping_model,
                 .friction = options.friction,
                 .mean_rest_length = mean_structural_length(cloth),
                 .buckling_rigidity = options.buckling_rigidity}};
  return options.material ? with_needed_springs(std::move(cloth)) : cloth;
}

}  // namespace billow::sim
