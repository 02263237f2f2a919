// The run as one glTF file, for browsers and other programs.
#pragma once

#include <vector>

#include "cli/cache/glb_file.h"
#include "cli/run/recorder.h"
#include "cli/run/schedule.h"

namespace billow::cli {

/// Keeps at most `most_keys` of the drawn frames, evenly over them, the first and the last included; then writes
/// caches/scene.glb, and the same bytes as the script that shows them on the run's page. A run that ends early has the
/// keys up to there; one without any frame writes neither.
class GlbRecorder : public Recorder {
 public:
  static constexpr long most_keys = 60;

  GlbRecorder(const RecorderSetting& setting, FilmReport& report);
  double wants() const override { return frames_.next(); }
  void add(double time, const sim::State& state) override;
  void finish() override;

 private:
  const RecorderSetting& setting_;
  FilmReport& report_;
  Schedule frames_;
  std::vector<GlbKey> keys_;
};

}  // namespace billow::cli
