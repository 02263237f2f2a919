// Particles -> cells -> spectrum -> files.
#include "cli/spectrum_recorder.h"

#include <fmt/format.h>

#include "render/atomic_file.h"
#include "render/png.h"

namespace billow::cli {

SpectrumRecorder::SpectrumRecorder(const Scene& scene, const Simulation& simulation)
    : spec_(*scene.spectrum),
      first_particle_(simulation.structure().body[spec_.body].first_particle),
      grid_(sim::grid_sampling(scene.bodies[spec_.body].mesh)) {}

Eigen::MatrixX3d SpectrumRecorder::cells(const sim::State& state) const {
  return grid_.sample(state.velocity.middleRows(first_particle_, grid_.weight.cols()));
}

void SpectrumRecorder::add(const sim::State& state) {
  mean_.add(render::spectrum_of(cells(state), grid_.width, grid_.height, spec_.window));
}

void SpectrumRecorder::show(const sim::State& state) { shown_ = cells(state); }

void SpectrumRecorder::finish(const OutputFolder& folder, double velocity_range) const {
  if (shown_)
    render::write_png(folder.velocity_image(),
                      render::velocity_picture(*shown_, grid_.width, grid_.height, velocity_range));
  if (mean_.empty()) return;
  const render::Spectrum mean = mean_.mean();
  render::write_png(folder.spectrum(), render::spectrum_picture(mean, spec_.range));
  const Eigen::VectorXd radial = render::radial_power(mean);
  std::string csv = "radial_frequency,mean_square_velocity\n";
  for (Eigen::Index r = 0; r < radial.size(); ++r) csv += fmt::format("{},{}\n", r, radial(r));
  render::write_file_atomically(folder.spectrum_table(), csv);
}

}  // namespace billow::cli
