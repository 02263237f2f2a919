// Vertices that faces join.
#include "sim/mesh/pieces.h"

#include "sim/mesh/disjoint_sets.h"

namespace billow::sim {

std::vector<std::vector<int>> pieces(const Mesh& mesh) {
  DisjointSets sets(mesh.vertices());
  for (const Face& face : mesh.face)
    for (int c = 1; c < corner_count(face); ++c) sets.join(face[0], face[c]);
  std::vector<int> number(static_cast<std::size_t>(mesh.vertices()), -1);
  std::vector<std::vector<int>> list;
  for (int v = 0; v < mesh.vertices(); ++v) {
    int& piece = number[static_cast<std::size_t>(sets.root(v))];
    if (piece < 0) {
      piece = static_cast<int>(list.size());
      list.emplace_back();
    }
    list[static_cast<std::size_t>(piece)].push_back(v);
  }
  return list;
}

}  // namespace billow::sim
