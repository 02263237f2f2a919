// Meshes -> cloths to step.
#include "bench/cloths.h"

#include <map>
#include <memory>
#include <utility>

#include "sim/body/cloth.h"
#include "sim/import/mesh_import.h"

namespace billow::bench {

sim::Mesh grid_mesh(int width) {
  sim::Mesh mesh;
  mesh.position.resize(static_cast<Eigen::Index>(width) * width, 3);
  for (int row = 0; row < width; ++row)
    for (int column = 0; column < width; ++column)
      mesh.position.row(width * row + column) << column / (width - 1.0), 0.0, row / (width - 1.0);
  for (int row = 0; row + 1 < width; ++row)
    for (int column = 0; column + 1 < width; ++column) {
      const int corner = width * row + column;
      mesh.face.push_back({corner, corner + width, corner + width + 1, corner + 1});
    }
  return mesh;
}

namespace {

sim::Mesh halved(const sim::Mesh& mesh) {
  sim::Mesh result;
  std::map<std::pair<int, int>, int> middle;
  const auto middle_of = [&](int a, int b) {
    return middle.try_emplace(std::minmax(a, b), mesh.vertices() + static_cast<int>(middle.size())).first->second;
  };
  for (const sim::Face& face : mesh.face) {
    const int a = middle_of(face[0], face[1]), b = middle_of(face[1], face[2]), c = middle_of(face[2], face[0]);
    for (const sim::Face& part : {sim::Face{face[0], a, c, -1}, sim::Face{a, face[1], b, -1},
                                  sim::Face{c, b, face[2], -1}, sim::Face{a, b, c, -1}})
      result.face.push_back(part);
  }
  result.position.resize(mesh.vertices() + static_cast<Eigen::Index>(middle.size()), 3);
  result.position.topRows(mesh.vertices()) = mesh.position;
  for (const auto& [ends, vertex] : middle)
    result.position.row(vertex) = 0.5 * (mesh.position.row(ends.first) + mesh.position.row(ends.second));
  return result;
}

}  // namespace

sim::Mesh irregular_mesh(int halvings) {
  sim::Mesh mesh = sim::import_mesh(BILLOW_SOURCE_DIR "/assets/meshes/cloth_irregular.obj");
  mesh.uv.clear();
  for (int k = 0; k < halvings; ++k) mesh = halved(mesh);
  return mesh;
}

sim::Structure cloth_of(const sim::Mesh& mesh) {
  sim::ClothOptions options;
  options.pinned = {0, 1};
  return sim::build_cloth(mesh, options);
}

const sim::Structure& cloth(const std::string& name) {
  static std::map<std::string, std::unique_ptr<const sim::Structure>> built;
  std::unique_ptr<const sim::Structure>& structure = built[name];
  if (!structure) {
    const int size = std::stoi(name.substr(name.find(' ')));
    const bool regular = name.starts_with("grid");
    structure = std::make_unique<const sim::Structure>(cloth_of(regular ? grid_mesh(size) : irregular_mesh(size)));
  }
  return *structure;
}

}  // namespace billow::bench
