// The one place that knows assimp.
#include "sim/import/assimp_reader.h"

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
#include "sim/import/mesh_folder.h"
#include "sim/import/soup_builder.h"

namespace billow::sim {
namespace {

namespace fs = std::filesystem;

// Opens the mesh and regular files of its folder tree, nothing else: it may name any path as its material or buffer.
class FolderOnly : public Assimp::DefaultIOSystem {
 public:
  FolderOnly(const fs::path& file, const ImportLimits& limits) : folder_(file, limits.max_file_bytes) {}

  bool Exists(const char* file) const override { return allowed(file) && DefaultIOSystem::Exists(file); }

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    const bool reads = mode[0] == 'r' && std::string_view(mode).find('+') == std::string_view::npos;
    return reads && allowed(file) ? DefaultIOSystem::Open(file, mode) : nullptr;
  }

  // Of the last path that was asked for outside the folder, or "".
  const std::string& refusal() const { return refusal_; }

 private:
  bool allowed(const char* file) const {
    const MeshFolder::Answer answer = folder_.ask(fs::absolute(file));
    if (answer == MeshFolder::Answer::outside || answer == MeshFolder::Answer::link_outside)
      refusal_ = outside_reason(file, answer);
    return answer == MeshFolder::Answer::allowed;
  }

  MeshFolder folder_;
  mutable std::string refusal_;
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
  Gatherer(const aiScene& scene, const ImportLimits& limits) : scene_(scene), builder_(limits) {}

  // Depth first, children in order. A stack of its own: a deep tree must not overflow the call stack.
  PolygonSoup soup() {
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
    return builder_.soup();
  }

 private:
  // A node still to be visited, with what its parents hand down.
  struct Visit {
    const aiNode* node;
    aiMatrix4x4 to_world;
    std::vector<std::string> names;
  };

  void add_mesh(const aiMesh& mesh, const Visit& visit) {
    const int first = builder_.vertices();
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) add_vertex(mesh, v, visit.to_world);
    const bool mirrored = visit.to_world.Determinant() < 0.0f;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) add_face(mesh.mFaces[f], mesh.mNumVertices, first, mirrored);
    add_groups(mesh, visit.names, first);
  }

  void add_vertex(const aiMesh& mesh, unsigned v, const aiMatrix4x4& to_world) {
    const aiVector3D p = to_world * mesh.mVertices[v];
    const int vertex = builder_.add_vertex({p.x, p.y, p.z});
    if (mesh.HasTextureCoords(0)) builder_.set_uv(vertex, {mesh.mTextureCoords[0][v].x, mesh.mTextureCoords[0][v].y});
    if (mesh.HasVertexColors(0)) {
      const aiColor4D& colour = mesh.mColors[0][v];
      builder_.set_colour(vertex, {colour.r, colour.g, colour.b});
    }
  }

  void add_face(const aiFace& polygon, unsigned vertices, int first, bool mirrored) {
    SoupBuilder::Polygon added;
    for (unsigned k = 0; k < polygon.mNumIndices; ++k) {
      if (polygon.mIndices[k] >= vertices)
        throw InputError(
            fmt::format("a face uses vertex {}, but there are {}; export it again", polygon.mIndices[k], vertices));
      added.corner.push_back(first + static_cast<long long>(polygon.mIndices[k]));
    }
    if (mirrored) std::reverse(added.corner.begin(), added.corner.end());  // a mirror turns faces over
    builder_.add_polygon(added);
  }

  void add_groups(const aiMesh& mesh, std::vector<std::string> names, int first) {
    names.emplace_back(mesh.mName.C_Str());
    names.emplace_back(scene_.mMaterials[mesh.mMaterialIndex]->GetName().C_Str());
    for (const std::string& name : std::set<std::string>(names.begin(), names.end()))
      for (int v = first; v < builder_.vertices() && !is_invented(name); ++v) builder_.add_member(name, v);
  }

  const aiScene& scene_;
  SoupBuilder builder_;
};

// Assimp's own words, or ours where it only repeats what a container threw.
std::string reason(const std::string& assimp_error, const std::string& refusal) {
  if (!refusal.empty()) return refusal;
  if (assimp_error.find("bad_alloc") != assimp_error.npos) throw std::bad_alloc();
  return fmt::format("assimp cannot read it ({}); export it again, or in another format", assimp_error);
}

}  // namespace

PolygonSoup read_with_assimp(const fs::path& file, const ImportLimits& limits) {
  std::string extension = file.extension().string().substr(1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  Assimp::Importer importer;
  keep_only(importer, extension);
  const fs::path absolute = fs::absolute(file);
  auto* folder = new FolderOnly(absolute, limits);  // the importer deletes it
  importer.SetIOHandler(folder);
  const aiScene* scene = importer.ReadFile(absolute.string(), 0);
  if (!scene) throw InputError(reason(importer.GetErrorString(), folder->refusal()));
  return Gatherer(*scene, limits).soup();
}

}  // namespace billow::sim
