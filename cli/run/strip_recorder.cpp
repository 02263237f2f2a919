// State -> column.
#include "cli/run/strip_recorder.h"

#include "cli/run/film.h"

namespace billow::cli {

StripRecorder::StripRecorder(const RecorderSetting& setting, FilmReport& report)
    : columns_(strip_schedule(setting.run.scene, setting.range.last)),
      rows_(setting.run.scene, setting.run.simulation.structure()),
      strip_(setting.folder.file(RunFile::strip), rows_.order(), setting.velocity_range),
      report_(report) {}

void StripRecorder::add(double time, const sim::State& state) {
  if (columns_.take(time)) strip_.add_column(rows_.of(state.velocity));
}

void StripRecorder::finish() {
  report_.strip_columns = strip_.columns();
  if (report_.strip_columns > 0) strip_.finish();
}

}  // namespace billow::cli
