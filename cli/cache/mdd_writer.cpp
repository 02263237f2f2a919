// MDD, LightWave's point cache. Big-endian: int32 frames, int32 points, a float time [s] for every frame; then x y z of
// every point, frame after frame.
#include "cli/cache/cache_writer.h"
#include "cli/cache/point_samples.h"

namespace billow::cli {
namespace {

class MddWriter : public CacheWriter {
 public:
  MddWriter(const std::filesystem::path& folder, const CacheMesh& mesh)
      : mesh_(mesh), samples_(folder / MddWriter::file()) {}

  void add(const CacheFrame& frame) override {
    put<ByteOrder::big>(times_, static_cast<float>(frame.time));
    samples_.add(frame.position);
  }

  void finish() override {
    std::string head;
    put<ByteOrder::big>(head, samples_.count());
    put<ByteOrder::big>(head, std::int32_t{mesh_.layout.vertices()});
    samples_.write(head + times_);
  }

  std::string file() const override { return mesh_.name + ".mdd"; }

 private:
  const CacheMesh& mesh_;
  PointSamples<ByteOrder::big> samples_;
  std::string times_;
};

}  // namespace

std::unique_ptr<CacheWriter> make_mdd_writer(const std::filesystem::path& folder, const CacheMesh& mesh) {
  return std::make_unique<MddWriter>(folder, mesh);
}

}  // namespace billow::cli
