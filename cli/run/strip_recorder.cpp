// State -> column.
#include "cli/run/strip_recorder.h"

#include "cli/run/film.h"

namespace billow::cli {

StripRecorder::StripRecorder(const RecorderSetting& setting, FilmReport& report)
    : columns_(strip_schedule(setting.run.scene, setting.range.last)),
      rows_(setting.run.scene, setting.run.simulation.structure()),
      strip_(setting.folder.file(RunFile::strip), rows_.order(), setting.velocity_range),
      array_(setting.folder.file(RunFile::strip_array), "<f4"),
      report_(report) {}

void StripRecorder::add(double time, const sim::State& state) {
  if (!columns_.take(time)) return;
  const Eigen::MatrixX3d rows = rows_.of(state.velocity);
  strip_.add_column(rows);
  const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> numbers = rows.cast<float>();
  array_.append(numbers.data(), static_cast<std::size_t>(numbers.size()) * sizeof(float));
}

void StripRecorder::finish() {
  report_.strip_columns = strip_.columns();
  if (report_.strip_columns == 0) return;
  strip_.finish();
  const std::vector<long> shape = {report_.strip_columns, static_cast<long>(rows_.order().size()), 3};
  array_.finish(shape);
  report_.arrays.push_back(
      {std::string(word_of(RunFile::strip_array)), "<f4", shape, {"column", "row", "component"}, "m/s"});
}

}  // namespace billow::cli
