// Sums over frames.
#include "cli/run/response_recorder.h"

#include "cli/run/film.h"

namespace billow::cli {

ResponseRecorder::ResponseRecorder(const RecorderSetting& setting, FilmReport& report)
    : simulation_(setting.run.simulation),
      frames_(frame_schedule(setting.run.scene, setting.range.last)),
      report_(report) {}

void ResponseRecorder::add(double time, const sim::State& state) {
  if (!frames_.take(time)) return;
  const Simulation::Phase& phase = simulation_.phase_at(state.time);
  if (!phase.filter_operator()) return;  // levels that are not needed once pins have let go
  const sim::FilteredShare share = sim::filtered_share(phase.structure, *phase.filter_operator(), state.position,
                                                       state.time, state.velocity, scratch_);
  sum_.passed += share.passed, sum_.whole += share.whole;
}

void ResponseRecorder::finish() { report_.filter_response = sum_.response(); }

}  // namespace billow::cli
