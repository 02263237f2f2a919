// Bisection on whole runs.
#include "sim/limit/measured_limit.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "sim/body/momenta.h"

namespace billow::sim {

double energy_scale(const Structure& structure, const Forces& forces, const Eigen::Vector3d& gravity,
                    const State& initial) {
  const Eigen::RowVector3d size = initial.position.colwise().maxCoeff() - initial.position.colwise().minCoeff();
  const double weight = structure.mass.sum() * gravity.norm() * size.norm();
  const double most = std::max(weight, kinetic_energy(structure, initial));
  return most > 0.0 ? most : std::abs(forces.potential_energy(initial));
}

bool runs_stably(const Structure& structure, const Forces& forces, const SolverOptions& options, const State& initial,
                 double scale, const MeasurementOptions& measurement) {
  Solver solver(structure, forces, options, initial);
  double lowest = INFINITY;
  const long samples = std::lround(measurement.duration / measurement.interval);
  try {
    for (long k = 0; k <= samples; ++k) {
      const State state = solver.sample(static_cast<double>(k) * measurement.interval);
      const double energy = kinetic_energy(structure, state) + forces.potential_energy(state);
      lowest = std::min(lowest, energy);
      if (!(energy - lowest <= measurement.energy_tolerance * scale)) return false;
    }
  } catch (const DivergenceError&) {
    return false;
  }
  return true;
}

MeasuredStep measured_step(const Structure& structure, const Forces& forces, SolverOptions options,
                           const State& initial, double scale, double guess, double largest,
                           const MeasurementOptions& measurement) {
  const auto stable = [&](double h) {
    options.step = h;
    return runs_stably(structure, forces, options, initial, scale, measurement);
  };
  double low = 0.0, high = std::min(0.8 * guess, largest);
  while (stable(high)) {
    low = high;
    if (low >= largest) return {low, true};
    high = std::min(1.2 * low, largest);
  }
  for (int halvings = 0; low == 0.0 && halvings < 6; ++halvings) {
    if (stable(0.5 * high))
      low = 0.5 * high;
    else
      high *= 0.5;
  }
  if (low == 0.0) return {0.0, false};
  while (high - low > measurement.step_tolerance * high) {
    const double middle = 0.5 * (low + high);
    (stable(middle) ? low : high) = middle;
  }
  return {low, false};
}

}  // namespace billow::sim
