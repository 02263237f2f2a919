// Which vertices a scene means by a corner, a list, a box or a group.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <variant>
#include <vector>

#include "base/words.h"
#include "sim/mesh/mesh.h"

namespace billow::sim {

enum class Corner { top_left, top_right, bottom_left, bottom_right };
Words<Corner> words(Corner);
struct VertexList {
  std::vector<int> vertices;  // 0-based, in the mesh file's order
};
struct GroupName {
  std::string name;
};
/// The vertices whose weight is above a bound. A weight is a number of each vertex that the file names, a colour (red,
/// green or blue, from 0 to 1), or a group, which weighs 1.
struct WeightAbove {
  std::string name;
  double bound = 0.5;
};
/// Which vertices a scene means: a corner, a list, all inside a box (edges included), a mesh group, or by weight.
using Selector = std::variant<Corner, VertexList, Eigen::AlignedBox3d, GroupName, WeightAbove>;

/// The vertices a selector picks, ascending. Throws InputError when it picks none or names one that does not exist.
/// A corner is the vertex nearest that corner of the rectangle which its UVs fill when the mesh has UVs, else of the
/// bounding rectangle in the two axes in which the mesh extends most (up is +y, or -z for a mesh that lies flat).
std::vector<int> select_vertices(const Mesh& mesh, const Selector& selector);

}  // namespace billow::sim
