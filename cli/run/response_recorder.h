// What a force filter leaves of the motion that it is there to carry.
#pragma once

#include "cli/run/recorder.h"
#include "cli/run/schedule.h"
#include "sim/filter/response.h"

namespace billow::cli {

/// The filter's response to the velocities of the drawn frames, the mean of all weighted by kinetic energy, into the
/// report: by so much the motion's own accelerations are scaled.
class ResponseRecorder : public Recorder {
 public:
  /// The simulation must filter.
  ResponseRecorder(const RecorderSetting& setting, FilmReport& report);
  double wants() const override { return frames_.next(); }
  void add(double time, const sim::State& state) override;
  void finish() override;

 private:
  const Simulation& simulation_;
  Schedule frames_;
  sim::FilterScratch scratch_;
  sim::FilteredShare sum_;
  FilmReport& report_;
};

}  // namespace billow::cli
