// Which pairs of a mesh's vertices a cloth's springs join.
#pragma once

#include <vector>

#include "sim/body/structure.h"
#include "sim/mesh/mesh.h"

namespace billow::sim {

/// One spring of a cloth, first < second.
struct SpringPair {
  SpringKind kind;
  int first, second;
};

/// Which straight lines through a vertex carry bending: edges only, or also the shear springs, as the diagonals of
/// Choi & Ko's interlaced connections.
enum class BendLines { edges, edges_and_diagonals };

/// Structural springs on edges; shear springs on both diagonals of a quad and across the edge of two triangles; bend
/// springs straight across a vertex, two rings apart. No pair twice: structural goes before shear, shear before bend.
/// Ascending by (kind, first, second). A regular W x H grid of quads gets W(H-1) + H(W-1), 2(W-1)(H-1) and
/// (W-2)H + W(H-2) of them, and 2(W-2)(H-2) more bend springs with the diagonals. Throws InputError where more than
/// 1024 edges meet in a vertex.
std::vector<SpringPair> cloth_springs(const Mesh& mesh, BendLines bend_lines = BendLines::edges);

}  // namespace billow::sim
