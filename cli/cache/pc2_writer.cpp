// PC2, the point cache of 3ds Max and Blender. Little-endian: 12 characters "POINTCACHE2" and a zero, int32 version 1,
// int32 points, float first frame, float frames a sample, int32 samples; then x y z of every point, sample after
// sample.
#include "cli/cache/cache_writer.h"
#include "cli/cache/point_samples.h"

namespace billow::cli {
namespace {

class Pc2Writer : public CacheWriter {
 public:
  Pc2Writer(const std::filesystem::path& folder, const CacheMesh& mesh)
      : mesh_(mesh), samples_(folder / Pc2Writer::file()) {}

  void add(const CacheFrame& frame) override {
    if (samples_.count() == 0) first_frame_ = frame.number;
    if (samples_.count() == 1) frame_step_ = frame.number - first_frame_;
    // A sample's place says its time: frames that were chosen unevenly play one after the other.
    if (frame.number != first_frame_ + samples_.count() * frame_step_) frame_step_ = 1;
    samples_.add(frame.position);
  }

  void finish() override {
    std::string head("POINTCACHE2\0", 12);
    put<ByteOrder::little>(head, std::int32_t{1});
    put<ByteOrder::little>(head, std::int32_t{mesh_.layout.vertices()});
    put<ByteOrder::little>(head, static_cast<float>(first_frame_));
    put<ByteOrder::little>(head, static_cast<float>(frame_step_));
    put<ByteOrder::little>(head, samples_.count());
    samples_.write(head);
  }

  std::string file() const override { return mesh_.name + ".pc2"; }

 private:
  const CacheMesh& mesh_;
  PointSamples<ByteOrder::little> samples_;
  long first_frame_ = 1, frame_step_ = 1;
};

}  // namespace

std::unique_ptr<CacheWriter> make_pc2_writer(const std::filesystem::path& folder, const CacheMesh& mesh) {
  return std::make_unique<Pc2Writer>(folder, mesh);
}

}  // namespace billow::cli
