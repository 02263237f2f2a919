// What assimp loses of an OBJ file: the numbering of its vertices, the names of its groups, the lines of its faults.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// An OBJ file's vertices as its `v` lines number them. Users pin vertices by these numbers.
struct ObjVertices {
  std::vector<Eigen::Vector3d> position;  // (v)
  std::vector<Eigen::Vector2f> uv;        // (c) the `vt` lines
  std::vector<Face> face;                 // (f) of those vertices, in the file's order; larger polygons as fans
  std::vector<Face> uv_corner;            // (f) `vt` lines at the corners, counted from 0; -1 at a face without
  std::map<std::string, std::vector<int>>
      group;  // names of `g`, `o` and `usemtl` -> vertices of their faces, ascending
};

/// Scans the file's `v`, `vt`, `f`, `g`, `o` and `usemtl` lines. Throws InputError, with the line, on a number that is
/// not one (such as 1,5), on one that is not finite, and on a face whose vertex does not exist.
ObjVertices scan_obj(const std::filesystem::path& file);

/// `soup`, which assimp made of the same file with a copy of a vertex for every face corner, with its raw vertices in
/// the file's order, the file's groups in place of assimp's, and the layout of the file.
PolygonSoup in_file_order(const PolygonSoup& soup, const ObjVertices& vertices);

}  // namespace billow::sim
