// Small meshes, and the same mesh written in every format that billow reads.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/mesh/mesh.h"

namespace billow::test {

/// w x h vertices in the xz-plane facing +y, unit spacing, vertex x + w z, quads, uv in [0, 1]^2 with v = 1 at z = 0.
sim::Mesh quad_grid(int width, int height);

/// The mesh with every quad cut along its 0-2 diagonal.
sim::Mesh triangulated(const sim::Mesh& mesh);

/// A mesh of bare positions and faces.
sim::Mesh bare_mesh(const std::vector<Eigen::Vector3d>& positions, const std::vector<sim::Face>& faces);

/// The mesh's raw polygons, with a copy of a vertex for every corner of a face: what an OBJ file becomes in assimp.
sim::PolygonSoup soup_of(const sim::Mesh& mesh);

/// The bytes of a file that holds `mesh`, by extension without the dot: obj, off, ply, gltf, glb, or stl (as text). The
/// last three hold triangles only.
std::string mesh_file(std::string_view extension, const sim::Mesh& mesh);

/// A folder of the test's own, empty at the start and gone at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  /// Writes a file and returns its path.
  std::filesystem::path write(const std::string& name, std::string_view bytes) const;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace billow::test
