// What is drawn of a body: the plain data that the simulation hands to the renderer.
#pragma once

#include <Eigen/Core>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// The part of a drawn surface that stays the same for a whole run: t triangles over c corners over p points.
/// A corner is a (point, uv) pair, so a texture seam splits corners but not points, and normals stay smooth across it.
struct Surface {
  Eigen::MatrixX3i triangle;  // (t x 3) corner indices, counter-clockwise seen from the front
  Eigen::VectorXi point;      // (c)     the point each corner sits on
  Eigen::MatrixX2f uv;        // (c x 2) texture coordinates, v up
  Eigen::VectorXi material;   // (t)     ascending, counted from 0; empty: all 0
  Eigen::MatrixX3f colour;    // (c x 3) linear-light RGB, times what else is drawn; (0 x 3): white

  int points() const { return point.size() == 0 ? 0 : point.maxCoeff() + 1; }
};

/// The part that moves: one row per point.
struct SurfaceState {
  Eigen::MatrixX3f position;    // [m]   (p x 3)
  Eigen::MatrixX3f velocity;    // [m/s] (p x 3)
  Eigen::VectorXf strain = {};  //     (p) mean |l / l_0 - 1| of the structural springs that meet there; empty: none
};

/// The drawn surface of `mesh`: quads split along their shorter diagonal, one corner per distinct (vertex, uv).
/// Without UVs, texture coordinates come from the two largest extents of the bounding box. Triangles keep the order of
/// the faces, those of each of the mesh's materials together.
Surface build_surface(const Mesh& mesh);

}  // namespace billow::sim
