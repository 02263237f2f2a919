// The spectrum of a run's motion, gathered while it runs.
#pragma once

#include <optional>

#include "cli/output_folder.h"
#include "cli/simulation.h"
#include "render/spectrum.h"
#include "sim/grid_sampling.h"

namespace billow::cli {

/// Of the cloth that the scene's `spectrum` names.
class SpectrumRecorder {
 public:
  SpectrumRecorder(const Scene& scene, const Simulation& simulation);

  /// One more sample of the mean.
  void add(const sim::State& state);
  /// The moment that the velocity image shows.
  void show(const sim::State& state);
  /// Writes the velocity image, the spectrum's picture and its curve. Throws OutputError.
  void finish(const OutputFolder& folder, double velocity_range) const;

 private:
  Eigen::MatrixX3d cells(const sim::State& state) const;

  SpectrumSpec spec_;
  int first_particle_;
  sim::GridSampling grid_;
  render::SpectrumMean mean_;
  std::optional<Eigen::MatrixX3d> shown_;
};

}  // namespace billow::cli
