// A polygon mesh -> a cloth: structural, shear and bend springs, masses, pins.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/mesh.h"
#include "sim/structure.h"
#include "sim/surface.h"

namespace billow::sim {

enum class Corner { top_left, top_right, bottom_left, bottom_right };
struct VertexList {
  std::vector<int> vertices;  // 0-based, in the mesh file's order
};
struct GroupName {
  std::string name;
};
/// Which vertices a scene means: a corner, a list, all inside a box (edges included), or a mesh group.
using Selector = std::variant<Corner, VertexList, Eigen::AlignedBox3d, GroupName>;

/// The vertices a selector picks, ascending. Throws InputError when it picks none or names one that does not exist.
/// A corner is the vertex nearest that corner of the rectangle which its UVs fill when the mesh has UVs, else of the
/// bounding rectangle in the two axes in which the mesh extends most (up is +y, or -z for a mesh that lies flat).
std::vector<int> select_vertices(const Mesh& mesh, const Selector& selector);

struct ClothOptions {
  std::string name = "cloth";
  double mass = 0.2;                          // [kg]    of the whole cloth
  bool mass_by_area = true;                   //         else the same for every particle
  double structural = 115.0;                  // [N/m]   edges
  double shear = 80.0;                        // [N/m]   quad diagonals and across the edges of triangle pairs
  double bend = 35.0;                         // [N/m]   straight across a vertex, two rings apart
  std::optional<double> max_eigenvalue = {};  // [1/s^2] scales the three so that lambda_max(M^-1 K) is this
  SpringModel spring_model = SpringModel::linear;
  double buckling_rigidity = 0.0;  // [N m^2] choi_ko only
  DampingModel damping_model = DampingModel::projected;
  double damping = 0.0;          // [N s/m] of every spring
  double friction = 0.0;         // [kg/s]  fluid friction of every particle
  std::vector<int> pinned = {};  //         vertices, ascending
};

/// The cloth of `mesh`: one particle per vertex, springs as docs/method.md describes. Throws InputError on a mesh
/// with a zero-length edge or a particle without mass.
Structure build_cloth(const Mesh& mesh, const ClothOptions& options);

/// The drawn surface of `mesh`: quads split along their shorter diagonal, one corner per distinct (vertex, uv).
/// Without UVs, texture coordinates come from the two largest extents of the bounding box.
Surface build_surface(const Mesh& mesh);

}  // namespace billow::sim
