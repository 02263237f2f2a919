// Stanford PLY, binary, little-endian, one file a frame. A vertex is x y z, its velocity vx vy vz, and s t where every
// vertex has one texture coordinate.
#include <fmt/format.h>

#include "base/atomic_file.h"
#include "cli/cache/bytes.h"
#include "cli/cache/cache_writer.h"

namespace billow::cli {
namespace {

constexpr ByteOrder ply_order = ByteOrder::little;

class PlyWriter : public CacheWriter {
 public:
  PlyWriter(const std::filesystem::path& folder, const CacheMesh& mesh)
      : folder_(folder), mesh_(mesh), uv_(vertex_uv(mesh.layout)) {
    for (const sim::Face& face : mesh.layout.face) {
      const int corners = sim::corner_count(face);
      faces_.push_back(static_cast<char>(corners));
      for (int c = 0; c < corners; ++c) put<ply_order>(faces_, std::int32_t{face[c]});
    }
  }

  void add(const CacheFrame& frame) override {
    std::string bytes = head(frame);
    for (Eigen::Index v = 0; v < frame.position.rows(); ++v) {
      put_rows<ply_order>(bytes, frame.position.row(v));
      put_rows<ply_order>(bytes, frame.velocity.row(v));
      if (uv_) put_rows<ply_order>(bytes, uv_->row(v));
    }
    write_file_atomically(folder_ / frame_file(mesh_, frame.number, "ply"), bytes + faces_);
    if (first_frame_ == 0) first_frame_ = frame.number;
  }
  void finish() override {}
  std::string file() const override { return frame_file(mesh_, first_frame_, "ply"); }

 private:
  std::string head(const CacheFrame& frame) const {
    std::string text =
        fmt::format("ply\nformat binary_little_endian 1.0\ncomment billow: y up, metres, time {} s\n", frame.time);
    text += fmt::format("element vertex {}\n", frame.position.rows());
    for (const char* property : {"x", "y", "z", "vx", "vy", "vz"}) text += fmt::format("property float {}\n", property);
    if (uv_) text += "property float s\nproperty float t\n";
    return text + fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                              mesh_.layout.face.size());
  }

  const std::filesystem::path folder_;
  const CacheMesh& mesh_;
  const std::optional<Eigen::MatrixX2f> uv_;
  std::string faces_;  // as bytes
  long first_frame_ = 0;
};

}  // namespace

std::unique_ptr<CacheWriter> make_ply_writer(const std::filesystem::path& folder, const CacheMesh& mesh) {
  return std::make_unique<PlyWriter>(folder, mesh);
}

}  // namespace billow::cli
