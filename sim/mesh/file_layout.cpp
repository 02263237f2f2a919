// A mesh without a file has a layout too.
#include "sim/mesh/file_layout.h"

#include <numeric>

#include "sim/mesh/mesh.h"

namespace billow::sim {
namespace {

void add_corner_uvs(const Mesh& mesh, FileLayout& layout) {
  std::vector<Eigen::Vector2f> uv;
  for (std::size_t f = 0; f < mesh.uv.size(); ++f) {
    Face corner{-1, -1, -1, -1};
    for (int c = 0; c < corner_count(mesh.face[f]); ++c) {
      corner[c] = static_cast<int>(uv.size());
      uv.push_back(mesh.uv[f][c]);
    }
    layout.uv_corner.push_back(corner);
  }
  layout.uv.resize(static_cast<Eigen::Index>(uv.size()), 2);
  for (std::size_t k = 0; k < uv.size(); ++k) layout.uv.row(static_cast<Eigen::Index>(k)) = uv[k];
}

}  // namespace

FileLayout file_layout(const Mesh& mesh) {
  if (!mesh.layout.empty()) return mesh.layout;
  FileLayout layout;
  layout.vertex.resize(static_cast<std::size_t>(mesh.vertices()));
  std::iota(layout.vertex.begin(), layout.vertex.end(), 0);
  layout.face = mesh.face;
  add_corner_uvs(mesh, layout);
  return layout;
}

}  // namespace billow::sim
