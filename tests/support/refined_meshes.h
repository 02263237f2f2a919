// The same shape by meshes of any fineness.
#pragma once

#include "sim/mesh/mesh.h"

namespace billow::test {

/// Kinds of meshes of a rectangle: squares; squares cut along one diagonal; triangles in rows that are offset by half;
/// squares and triangles whose inner vertices are moved by up to a fifth of an edge, cut either way.
enum class Weave { squares, cut_squares, offset_rows, shaken_squares, shaken_triangles };

/// [0, length] x [0, width] in the xy-plane, facing +z, `across` cells along y and squares' as many along x.
sim::Mesh sheet(Weave weave, double length, double width, int across);

/// The unit sphere: an icosahedron whose triangles are cut in four `times` times, 10 * 4^times + 2 vertices.
sim::Mesh sphere(int times);

/// [0, size] with square cells, `fineness` of them to a unit of length.
sim::Mesh box(const Eigen::Vector3i& size, int fineness);

}  // namespace billow::test
