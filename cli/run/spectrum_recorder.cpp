// Particles -> cells -> spectrum -> files.
#include "cli/run/spectrum_recorder.h"

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/npy_file.h"
#include "cli/run/film.h"
#include "render/image/png.h"

namespace billow::cli {

SpectrumRecorder::SpectrumRecorder(const RecorderSetting& setting, FilmReport& report)
    : folder_(setting.folder),
      velocity_range_(setting.velocity_range),
      spec_(*setting.run.scene.spectrum),
      samples_(spectrum_schedule(setting.run.scene, setting.range.last)),
      image_(velocity_image_schedule(setting.run.scene, setting.range.last)),
      first_particle_(setting.run.simulation.structure().body[spec_.body].first_particle),
      grid_(sim::grid_sampling(setting.run.scene.bodies[spec_.body].mesh)),
      report_(report) {}

Eigen::MatrixX3d SpectrumRecorder::cells(const sim::State& state) const {
  return grid_.sample(state.velocity.middleRows(first_particle_, grid_.weight.cols()));
}

void SpectrumRecorder::add(double time, const sim::State& state) {
  if (samples_.take(time)) mean_.add(render::spectrum_of(cells(state), grid_.width, grid_.height, spec_.window));
  if (image_.take(time)) shown_ = cells(state);
}

void SpectrumRecorder::write_array(RunFile file, const double* numbers, const std::vector<long>& shape,
                                   const std::vector<std::string>& axes, const std::string& unit) {
  std::size_t count = 1;
  for (const long size : shape) count *= static_cast<std::size_t>(size);
  NpyFile array(folder_.file(file), "<f8");
  array.append(numbers, count * sizeof(double));
  array.finish(shape);
  report_.arrays.push_back({std::string(word_of(file)), "<f8", shape, axes, unit});
}

void SpectrumRecorder::finish() {
  const long width = grid_.width, height = grid_.height;
  if (shown_) {
    render::write_png(folder_.file(RunFile::velocity_image),
                      render::velocity_picture(*shown_, grid_.width, grid_.height, velocity_range_));
    const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> cells = *shown_;
    write_array(RunFile::velocity_image_array, cells.data(), {height, width, 3}, {"y", "x", "component"}, "m/s");
  }
  if (mean_.empty()) return;
  const render::Spectrum mean = mean_.mean();
  render::write_png(folder_.file(RunFile::spectrum), render::spectrum_picture(mean, spec_.range));
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> power = mean.power;
  write_array(RunFile::spectrum_array, power.data(), {height, width}, {"frequency_y", "frequency_x"}, "m^2/s^2");
  const Eigen::VectorXd radial = render::radial_power(mean);
  std::string csv = "radial_frequency,mean_square_velocity\n";
  for (Eigen::Index r = 0; r < radial.size(); ++r) csv += fmt::format("{},{}\n", r, radial(r));
  write_file_atomically(folder_.file(RunFile::spectrum_table), csv);
}

}  // namespace billow::cli
