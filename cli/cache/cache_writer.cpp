// Which format is written by whom.
#include "cli/cache/cache_writer.h"

#include <fmt/format.h>

namespace billow::cli {

std::unique_ptr<CacheWriter> make_cache_writer(CacheFormat format, const std::filesystem::path& folder,
                                               const CacheMesh& mesh) {
  switch (format) {
    case CacheFormat::pc2:
      return make_pc2_writer(folder, mesh);
    case CacheFormat::mdd:
      return make_mdd_writer(folder, mesh);
    case CacheFormat::obj:
      return make_obj_writer(folder, mesh);
    case CacheFormat::ply:
      return make_ply_writer(folder, mesh);
    case CacheFormat::vtp:
      return make_vtp_writer(folder, mesh);
    case CacheFormat::glb:
      return nullptr;
  }
  return nullptr;
}

bool has_file_per_frame(CacheFormat format) {
  return format == CacheFormat::obj || format == CacheFormat::ply || format == CacheFormat::vtp;
}

std::string frame_file(const CacheMesh& mesh, long frame, std::string_view extension) {
  return fmt::format("{}/frame_{:04}.{}", mesh.name, frame, extension);
}

std::optional<Eigen::MatrixX2f> vertex_uv(const sim::FileLayout& layout) {
  if (layout.uv_corner.empty()) return std::nullopt;
  Eigen::MatrixX2f uv = Eigen::MatrixX2f::Zero(layout.vertices(), 2);
  std::vector<bool> known(layout.vertex.size());
  for (std::size_t f = 0; f < layout.face.size(); ++f)
    for (int c = 0; c < sim::corner_count(layout.face[f]); ++c) {
      const int v = layout.face[f][c], corner = layout.uv_corner[f][c];
      if (corner < 0 || (known[v] && uv.row(v) != layout.uv.row(corner))) return std::nullopt;
      uv.row(v) = layout.uv.row(corner);
      known[v] = true;
    }
  return uv;
}

}  // namespace billow::cli
