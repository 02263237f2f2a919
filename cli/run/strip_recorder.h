// The RGB velocity-evolution strip of a run.
#pragma once

#include "base/npy_file.h"
#include "cli/run/recorder.h"
#include "cli/run/schedule.h"
#include "cli/run/strip_rows.h"
#include "render/image/velocity_strip.h"

namespace billow::cli {

class StripRecorder : public Recorder {
 public:
  StripRecorder(const RecorderSetting& setting, FilmReport& report);
  double wants() const override { return columns_.next(); }
  void add(double time, const sim::State& state) override;
  /// Writes the strip, as a picture and as numbers, if it has a column, and says so in the report.
  void finish() override;

 private:
  Schedule columns_;
  StripRows rows_;
  render::VelocityStrip strip_;
  NpyFile array_;
  FilmReport& report_;
};

}  // namespace billow::cli
