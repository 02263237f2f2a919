// How a mesh's file numbers its vertices: what other programs that load the file expect of us.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/mesh/face.h"

namespace billow::sim {

struct Mesh;

/// w vertices as the file lists them, copies along texture seams and vertices of no face included; f faces, larger
/// polygons cut into fans, none dropped.
struct FileLayout {
  std::vector<int> vertex;      //     (w)     the mesh's vertex that each became; -1: none, as no face uses it
  Eigen::MatrixX3d loose;       // [m] (l x 3) where those are that became none, in order
  std::vector<Face> face;       //     (f)     of the file's vertices
  Eigen::MatrixX2f uv;          //     (c x 2) texture coordinates; (0 x 2) where the file has none
  std::vector<Face> uv_corner;  //     (f)     rows of uv at each face's corners, -1 at a face without; empty: no uv

  bool empty() const { return vertex.empty(); }
  int vertices() const { return static_cast<int>(vertex.size()); }

  /// Rows of `of_mesh` (v x n), one for each of the mesh's vertices, given to the file's (w x n); the loose ones get
  /// those of `of_loose` (l x n).
  template <class Rows>
  Rows spread(const Rows& of_mesh, const Rows& of_loose) const {
    Rows rows(vertices(), of_mesh.cols());
    Eigen::Index next_loose = 0;
    for (int k = 0; k < vertices(); ++k) {
      if (vertex[k] >= 0)
        rows.row(k) = of_mesh.row(vertex[k]);
      else
        rows.row(k) = of_loose.row(next_loose++);
    }
    return rows;
  }
};

/// The layout of the file that `mesh` was read from; where there was none, the mesh's own numbering, with one texture
/// coordinate for every corner.
FileLayout file_layout(const Mesh& mesh);

}  // namespace billow::sim
