// The geometry caches of a run: DIR/caches.
#pragma once

#include <memory>
#include <vector>

#include "cli/run/cache_geometry.h"
#include "cli/run/recorder.h"
#include "cli/run/schedule.h"

namespace billow::cli {

/// Every frame of the range, of every body and collider, in every format of one mesh that the scene asks for; and each
/// mesh at t = 0 as NAME.rest.obj. A run that ends early leaves caches of the frames that it has. Frames are written
/// anew when a run is resumed: they cost less than to find out which are whole.
class CacheRecorder : public Recorder {
 public:
  /// Makes the folders. Throws OutputError.
  CacheRecorder(const RecorderSetting& setting, FilmReport& report);
  double wants() const override { return frames_.next(); }
  void add(double time, const sim::State& state) override;
  /// Says in the report what there is.
  void finish() override;

 private:
  struct Output {
    CacheFormat format;
    std::size_t mesh;  // its number
    std::unique_ptr<CacheWriter> writer;
  };
  void make_writers(const std::vector<CacheFormat>& formats);

  std::filesystem::path folder_;
  FrameRange range_;
  Schedule frames_;
  FilmReport& report_;
  CacheGeometry geometry_;
  std::vector<Output> output_;
  long written_ = 0;  // frames
};

}  // namespace billow::cli
