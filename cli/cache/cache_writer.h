// What every format of geometry caches is written through. Knows nothing of scenes.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cli/scene/cache_format.h"
#include "sim/mesh/file_layout.h"

namespace billow::cli {

/// What stays the same of one body or collider: w vertices and its faces, as its file has them.
struct CacheMesh {
  std::string name;        // a file name's beginning
  sim::FileLayout layout;  // of w vertices
  Eigen::MatrixX3f rest;   // [m] (w x 3) at t = 0
};

/// Where it is in one frame, in the world.
struct CacheFrame {
  long number = 1;            // 1-based
  double time = 0.0;          // [s]
  Eigen::MatrixX3f position;  // [m]   (w x 3)
  Eigen::MatrixX3f velocity;  // [m/s] (w x 3)
  Eigen::VectorXf strain;     //       (w)     strain_of's
  Eigen::VectorXf contact;    //       (w)     touching's
};

/// One format of one mesh.
class CacheWriter {
 public:
  virtual ~CacheWriter() = default;
  /// Frames come in order. Throws OutputError.
  virtual void add(const CacheFrame& frame) = 0;
  /// After the last frame, which may come early; at least one was added. Throws OutputError.
  virtual void finish() = 0;
  /// What a program opens, relative to the caches' folder.
  virtual std::string file() const = 0;
};

/// A writer into `folder`, which exists, as does its sub-folder of the mesh's name where the format has a file for
/// every frame. `mesh` must outlive it. Null for glb, which is no cache of one mesh.
std::unique_ptr<CacheWriter> make_cache_writer(CacheFormat format, const std::filesystem::path& folder,
                                               const CacheMesh& mesh);
bool has_file_per_frame(CacheFormat format);

/// "NAME/frame_0001.EXTENSION".
std::string frame_file(const CacheMesh& mesh, long frame, std::string_view extension);

/// Texture coordinates (w x 2) of the vertices, (0, 0) of those of no face; none where the mesh has none, or a vertex
/// two different ones, as at the seams of an OBJ file.
std::optional<Eigen::MatrixX2f> vertex_uv(const sim::FileLayout& layout);

// The formats, one file each.
std::unique_ptr<CacheWriter> make_pc2_writer(const std::filesystem::path& folder, const CacheMesh& mesh);
std::unique_ptr<CacheWriter> make_mdd_writer(const std::filesystem::path& folder, const CacheMesh& mesh);
std::unique_ptr<CacheWriter> make_obj_writer(const std::filesystem::path& folder, const CacheMesh& mesh);
std::unique_ptr<CacheWriter> make_ply_writer(const std::filesystem::path& folder, const CacheMesh& mesh);
std::unique_ptr<CacheWriter> make_vtp_writer(const std::filesystem::path& folder, const CacheMesh& mesh);

/// The mesh as an OBJ file with its vertices at `position` (w x 3) [m]. Throws OutputError.
void write_obj(const std::filesystem::path& file, const CacheMesh& mesh, const Eigen::MatrixX3f& position);

}  // namespace billow::cli
