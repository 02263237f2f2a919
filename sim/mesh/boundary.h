// Where a mesh ends: its border edges as loops, and faces that close them.
#pragma once

#include <vector>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// The border of `mesh` as closed walks over edges of one face each, every such edge in exactly one, along the face's
/// own direction. Where borders touch at a vertex, a walk leaves it by the edge that comes first. Edges that lead
/// nowhere, as beside faces that are turned over, end theirs.
std::vector<std::vector<int>> border_loops(const Mesh& mesh);

/// The mesh with faces across the border loops of at most `most_edges` edges: no new vertices, the faces facing as
/// their neighbours do and looking like one of them.
Mesh with_holes_closed(const Mesh& mesh, int most_edges);

}  // namespace billow::sim
