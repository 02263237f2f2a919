// Union by the smaller number, so that the result depends on nothing but the faces.
#include "sim/mesh/pieces.h"

#include <algorithm>
#include <numeric>

namespace billow::sim {
namespace {

int root_of(std::vector<int>& parent, int v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

}  // namespace

std::vector<std::vector<int>> pieces(const Mesh& mesh) {
  std::vector<int> parent(static_cast<std::size_t>(mesh.vertices()));
  std::iota(parent.begin(), parent.end(), 0);
  for (const Face& face : mesh.face)
    for (int c = 1; c < corner_count(face); ++c) {
      const int one = root_of(parent, face[0]), other = root_of(parent, face[c]);
      parent[std::max(one, other)] = std::min(one, other);
    }
  std::vector<int> number(parent.size(), -1);
  std::vector<std::vector<int>> list;
  for (int v = 0; v < mesh.vertices(); ++v) {
    int& piece = number[static_cast<std::size_t>(root_of(parent, v))];
    if (piece < 0) {
      piece = static_cast<int>(list.size());
      list.emplace_back();
    }
    list[static_cast<std::size_t>(piece)].push_back(v);
  }
  return list;
}

}  // namespace billow::sim
