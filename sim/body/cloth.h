// A polygon mesh -> a cloth: structural, shear and bend springs, masses, pins.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/body/membrane_springs.h"
#include "sim/body/structure.h"
#include "sim/mesh/mesh.h"

namespace billow::sim {

/// What a sheet is made of, whatever its mesh.
struct SheetMaterial {
  MembraneModuli membrane;  // [N/m]
  double bend = 0.0;        // [N m]  flexural rigidity
};

struct ClothOptions {
  std::string name = "cloth";
  double mass = 0.2;                           // [kg]    of the whole cloth
  bool mass_by_area = true;                    //         else the same for every particle
  double structural = 115.0;                   // [N/m]   edges
  double shear = 80.0;                         // [N/m]   quad diagonals and across the edges of triangle pairs
  double bend = 35.0;                          // [N/m]   straight across a vertex, two rings apart
  std::optional<SheetMaterial> material = {};  // in place of these three
  SpringModel spring_model = SpringModel::linear;
  double buckling_rigidity = 0.0;  // [N m^2] choi_ko only
  DampingModel damping_model = DampingModel::projected;
  double damping = 0.0;          // [N s/m] of every spring
  double friction = 0.0;         // [kg/s]  fluid friction of every particle
  std::vector<int> pinned = {};  //         vertices, ascending
};

/// [m^2] of the mesh's faces, as masses are spread by it.
double area(const Mesh& mesh);

/// The cloth of `mesh`: one particle per vertex, springs as docs/method.md describes. With a material the springs carry
/// tensions at rest, in balance, that are the resistance to bending; those that it does not need are left out. Throws
/// InputError on a mesh with a zero-length edge or a particle without mass.
Structure build_cloth(const Mesh& mesh, const ClothOptions& options);

}  // namespace billow::sim
