// The one place that knows assimp.
#include "sim/mesh/assimp_reader.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/importerdesc.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"

namespace billow::sim {
namespace {

namespace fs = std::filesystem;

// Opens regular files of one folder tree and nothing else: a mesh may name any path as its material or buffer.
class FolderOnly : public Assimp::DefaultIOSystem {
 public:
  FolderOnly(const fs::path& folder, const ImportLimits& limits) : folder_(fs::canonical(folder)), limits_(limits) {}

  bool Exists(const char* file) const override { return allowed(file) && DefaultIOSystem::Exists(file); }

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    const bool reads = mode[0] == 'r' && std::string_view(mode).find('+') == std::string_view::npos;
    return reads && allowed(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
  }

  // The last path that was asked for outside the folder, or "".
  const std::string& refused() const { return refused_; }

 private:
  bool allowed(const char* file) const {
    std::error_code error;
    const fs::path path = fs::weakly_canonical(file, error);
    const auto [end, differs] = std::mismatch(folder_.begin(), folder_.end(), path.begin(), path.end());
    if (error || end != folder_.end()) {
      refused_ = file;
      return false;
    }
    return fs::is_regular_file(path, error) && fs::file_size(path, error) <= limits_.max_file_bytes;
  }

  fs::path folder_;
  const ImportLimits& limits_;
  mutable std::string refused_;
};

void keep_only(Assimp::Importer& importer, const std::string& extension) {
  std::vector<Assimp::BaseImporter*> others;
  for (std::size_t k = 0; k < importer.GetImporterCount(); ++k) {
    const aiImporterDesc* description = importer.GetImporterInfo(k);
    const std::string extensions = fmt::format(" {} ", description ? description->mFileExtensions : "");
    if (extensions.find(fmt::format(" {} ", extension)) == std::string::npos) others.push_back(importer.GetImporter(k));
  }
  for (Assimp::BaseImporter* other : others) importer.UnregisterLoader(other);
}

// Names that assimp or a file format made up, which no user would look for.
bool is_invented(const std::string& name) {
  static const std::set<std::string> known = {"", "DefaultMaterial", "defaultobject", "ROOT", "default"};
  return known.contains(name) || name.starts_with('<') || name.starts_with("nodes[") || name.starts_with("meshes[") ||
         name.starts_with("materials[");
}

// Gathers the meshes of a scene, one after the other, as one soup.
class Gatherer {
 public:
  Gatherer(const aiScene& scene, const ImportLimits& limits) : scene_(scene), limits_(limits) {}

  PolygonSoup soup() {
    visit_nodes();
    if (face_.empty()) throw InputError("it has no polygons; export the mesh with its faces");
    PolygonSoup soup;
    soup.position = rows<Eigen::MatrixX3d>(position_);
    if (has_uv_) soup.uv = rows<Eigen::MatrixX2f>(uv_);
    if (has_colour_) soup.colour = rows<Eigen::MatrixX3f>(colour_);
    soup.face = std::move(face_);
    soup.group = std::move(group_);
    return soup;
  }

 private:
  // A node still to be visited, with what its parents hand down.
  struct Visit {
    const aiNode* node;
    aiMatrix4x4 to_world;
    std::vector<std::string> names;
  };

  template <typename Matrix, typename Row>
  static Matrix rows(const std::vector<Row>& list) {
    Matrix matrix(static_cast<Eigen::Index>(list.size()), Matrix::ColsAtCompileTime);
    for (std::size_t r = 0; r < list.size(); ++r) matrix.row(static_cast<Eigen::Index>(r)) = list[r].transpose();
    return matrix;
  }

  // Depth first, children in order. A stack of its own: a deep tree must not overflow the call stack.
  void visit_nodes() {
    std::vector<Visit> open = {{scene_.mRootNode, aiMatrix4x4(), {}}};
    while (!open.empty()) {
      Visit visit = std::move(open.back());
      open.pop_back();
      visit.to_world = visit.to_world * visit.node->mTransformation;
      if (const std::string name = visit.node->mName.C_Str(); visit.node != scene_.mRootNode && !is_invented(name))
        visit.names.push_back(name);
      for (unsigned k = 0; k < visit.node->mNumMeshes; ++k) add_mesh(*scene_.mMeshes[visit.node->mMeshes[k]], visit);
      for (unsigned k = visit.node->mNumChildren; k-- > 0;)
        open.push_back({visit.node->mChildren[k], visit.to_world, visit.names});
    }
  }

  void add_mesh(const aiMesh& mesh, const Visit& visit) {
    const int first = static_cast<int>(position_.size());
    if (mesh.mNumVertices > static_cast<unsigned>(limits_.max_vertices - first))
      throw InputError(fmt::format("it has more than {} vertices; use a coarser mesh", limits_.max_vertices));
    add_vertices(mesh, visit.to_world);
    const bool mirrored = visit.to_world.Determinant() < 0.0f;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) add_face(mesh.mFaces[f], mesh.mNumVertices, first, mirrored);
    add_groups(mesh, visit.names, first);
  }

  void add_vertices(const aiMesh& mesh, const aiMatrix4x4& to_world) {
    has_uv_ = has_uv_ || mesh.HasTextureCoords(0);
    has_colour_ = has_colour_ || mesh.HasVertexColors(0);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D p = to_world * mesh.mVertices[v];
      const aiVector3D uv = mesh.HasTextureCoords(0) ? mesh.mTextureCoords[0][v] : aiVector3D();
      const aiColor4D colour = mesh.HasVertexColors(0) ? mesh.mColors[0][v] : aiColor4D(1, 1, 1, 1);
      position_.emplace_back(p.x, p.y, p.z);
      uv_.emplace_back(uv.x, uv.y);
      colour_.push_back(Eigen::Vector3f(colour.r, colour.g, colour.b).cwiseMax(0.0f).cwiseMin(1.0f));
    }
  }

  void add_face(const aiFace& polygon, unsigned vertices, int first, bool mirrored) {
    std::vector<int> corner;
    for (unsigned k = 0; k < polygon.mNumIndices; ++k) {
      if (polygon.mIndices[k] >= vertices)
        throw InputError(
            fmt::format("a face uses vertex {}, but there are {}; export it again", polygon.mIndices[k], vertices));
      corner.push_back(first + static_cast<int>(polygon.mIndices[k]));
    }
    if (corner.size() < 3) return;
    if (mirrored) std::reverse(corner.begin(), corner.end());  // a mirror turns counter-clockwise into clockwise
    if (corner.size() == 4) face_.push_back({corner[0], corner[1], corner[2], corner[3]});
    for (std::size_t k = 2; corner.size() != 4 && k < corner.size(); ++k)
      face_.push_back({corner[0], corner[k - 1], corner[k], -1});
    if (face_.size() > static_cast<std::size_t>(limits_.max_faces))
      throw InputError(fmt::format("it has more than {} faces; use a coarser mesh", limits_.max_faces));
  }

  void add_groups(const aiMesh& mesh, std::vector<std::string> names, int first) {
    names.emplace_back(mesh.mName.C_Str());
    names.emplace_back(scene_.mMaterials[mesh.mMaterialIndex]->GetName().C_Str());
    for (const std::string& name : std::set<std::string>(names.begin(), names.end())) {
      if (is_invented(name)) continue;
      std::vector<int>& members = group_[name];
      for (int v = first; v < static_cast<int>(position_.size()); ++v) members.push_back(v);
    }
  }

  const aiScene& scene_;
  const ImportLimits& limits_;
  std::vector<Eigen::Vector3d> position_;
  std::vector<Eigen::Vector2f> uv_;
  std::vector<Eigen::Vector3f> colour_;
  bool has_uv_ = false, has_colour_ = false;
  std::vector<Face> face_;
  std::map<std::string, std::vector<int>> group_;
};

// Assimp's own words, or ours where it only repeats what a container threw.
std::string reason(const std::string& assimp_error, const std::string& refused) {
  if (!refused.empty())
    return fmt::format("it refers to '{}', which is outside its own folder; keep all files of a mesh together",
                       refused);
  if (assimp_error.find("bad_alloc") != assimp_error.npos) throw std::bad_alloc();
  return fmt::format("{}; the file is probably broken, export it again", assimp_error);
}

}  // namespace

PolygonSoup read_with_assimp(const fs::path& file, const ImportLimits& limits) {
  std::string extension = file.extension().string().substr(1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  Assimp::Importer importer;
  keep_only(importer, extension);
  const fs::path absolute = fs::absolute(file);
  auto* folder = new FolderOnly(absolute.parent_path(), limits);  // the importer deletes it
  importer.SetIOHandler(folder);
  const aiScene* scene = importer.ReadFile(absolute.string(), 0);
  if (!scene) throw InputError(reason(importer.GetErrorString(), folder->refused()));
  return Gatherer(*scene, limits).soup();
}

}  // namespace billow::sim
