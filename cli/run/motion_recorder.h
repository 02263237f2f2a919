// Energy, momentum and stretch of every drawn frame.
#pragma once

#include "cli/run/recorder.h"
#include "cli/run/schedule.h"

namespace billow::cli {

/// Into the report's frame log and its curves, and at the end into a table.
class MotionRecorder : public Recorder {
 public:
  MotionRecorder(const RecorderSetting& setting, FilmReport& report);
  double wants() const override { return frames_.next(); }
  void add(double time, const sim::State& state) override;
  /// Writes the log as a table, frames.csv.
  void finish() override;

 private:
  const Simulation& simulation_;
  const OutputFolder& folder_;
  FrameRange range_;
  Schedule frames_;
  FilmReport& report_;
};

}  // namespace billow::cli
