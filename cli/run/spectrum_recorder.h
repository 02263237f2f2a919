// The spectrum of a run's motion, gathered while it runs.
#pragma once

#include <optional>

#include "cli/run/recorder.h"
#include "cli/run/schedule.h"
#include "render/image/spectrum.h"
#include "sim/drawn/grid_sampling.h"

namespace billow::cli {

/// Of the cloth that the scene's `spectrum` names: the mean of samples, and the velocity image of one moment.
class SpectrumRecorder : public Recorder {
 public:
  SpectrumRecorder(const RecorderSetting& setting, FilmReport& report);
  double wants() const override { return std::min(samples_.next(), image_.next()); }
  void add(double time, const sim::State& state) override;
  /// Writes the velocity image and the spectrum, as pictures and as numbers, and the spectrum's curve, as far as there
  /// are any.
  void finish() override;

 private:
  Eigen::MatrixX3d cells(const sim::State& state) const;
  void write_array(RunFile file, const double* numbers, const std::vector<long>& shape,
                   const std::vector<std::string>& axes, const std::string& unit);

  const OutputFolder& folder_;
  double velocity_range_;
  SpectrumSpec spec_;
  Schedule samples_, image_;
  int first_particle_;
  sim::GridSampling grid_;
  render::SpectrumMean mean_;
  std::optional<Eigen::MatrixX3d> shown_;
  FilmReport& report_;
};

}  // namespace billow::cli
