// Wavefront OBJ, one file a frame: `v`, `vt` and `f` lines as the mesh's own file has them.
#include <fmt/format.h>

#include <iterator>

#include "base/atomic_file.h"
#include "cli/cache/cache_writer.h"

namespace billow::cli {
namespace {

class ObjWriter : public CacheWriter {
 public:
  ObjWriter(const std::filesystem::path& folder, const CacheMesh& mesh) : folder_(folder), mesh_(mesh) {}

  void add(const CacheFrame& frame) override {
    write_obj(folder_ / frame_file(mesh_, frame.number, "obj"), mesh_, frame.position);
    if (first_frame_ == 0) first_frame_ = frame.number;
  }
  void finish() override {}
  std::string file() const override { return frame_file(mesh_, first_frame_, "obj"); }

 private:
  const std::filesystem::path folder_;
  const CacheMesh& mesh_;
  long first_frame_ = 0;
};

std::string face_line(const sim::Face& face, const sim::Face* uv) {
  std::string line = "f";
  for (int c = 0; c < sim::corner_count(face); ++c)
    line += uv && (*uv)[c] >= 0 ? fmt::format(" {}/{}", face[c] + 1, (*uv)[c] + 1) : fmt::format(" {}", face[c] + 1);
  return line + '\n';
}

}  // namespace

// fmt's shortest digits that give back the same float.
void write_obj(const std::filesystem::path& file, const CacheMesh& mesh, const Eigen::MatrixX3f& position) {
  std::string text = fmt::format("# billow: y up, metres\no {}\n", mesh.name);
  for (Eigen::Index v = 0; v < position.rows(); ++v)
    fmt::format_to(std::back_inserter(text), "v {} {} {}\n", position(v, 0), position(v, 1), position(v, 2));
  const sim::FileLayout& layout = mesh.layout;
  for (Eigen::Index c = 0; c < layout.uv.rows(); ++c)
    fmt::format_to(std::back_inserter(text), "vt {} {}\n", layout.uv(c, 0), layout.uv(c, 1));
  for (std::size_t f = 0; f < layout.face.size(); ++f)
    text += face_line(layout.face[f], layout.uv_corner.empty() ? nullptr : &layout.uv_corner[f]);
  write_file_atomically(file, text);
}

std::unique_ptr<CacheWriter> make_obj_writer(const std::filesystem::path& folder, const CacheMesh& mesh) {
  return std::make_unique<ObjWriter>(folder, mesh);
}

}  // namespace billow::cli
