// Polygons of any number of corners -> triangles and quads.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/mesh/face.h"

namespace billow::sim {

/// Corners (counted from 0) of the faces that a polygon with these corner positions (n x 3) becomes: itself for three
/// or four, a fan from its first corner where it is convex, else triangles inside it (ear clipping, Meisters 1975).
std::vector<Face> polygon_faces(const Eigen::MatrixX3d& corner);

}  // namespace billow::sim
