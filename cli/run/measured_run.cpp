// Where to look for a measured limit.
#include "cli/run/measured_run.h"

#include <cmath>

namespace billow::cli {

sim::MeasuredStep measure_step(const Scene& scene, const Simulation::Phase& phase, const sim::State& initial,
                               sim::Method method, const std::optional<sim::FilterOptions>& filter,
                               std::optional<double> certified, double k0) {
  sim::SolverOptions options;
  options.method = method;
  options.integrator = scene.solver.integrator;
  options.filter = filter;
  const double scale = sim::energy_scale(phase.structure, phase.forces, scene.gravity, initial);
  const double unit = 2.0 / std::sqrt(k0);
  // A scheme without a certified limit is tried at the paper's implicit step and somewhat beyond.
  const double guess = certified && *certified > 0.0 ? *certified : unit;
  const double first = sim::is_explicit(method) ? guess : 5.0 * unit;
  return sim::measured_step(phase.structure, phase.forces, options, initial, scale, first, 10.0 * unit,
                            {.duration = scene.duration});
}

}  // namespace billow::cli
