// The largest step at which the real, non-linear run behaves.
#pragma once

#include "sim/force/forces.h"
#include "sim/step/solver.h"

namespace billow::sim {

/// When a run counts as stable: over `duration`, looked at every `interval`, its total energy never climbs more than
/// `energy_tolerance` of the run's energy scale above its lowest value so far, and no spring is strained by more than
/// the solver's max_strain. "It did not explode" is not enough: a filtered run near its limit stays bounded while its
/// energy climbs.
struct MeasurementOptions {
  double duration = 10.0;          // [s]
  double interval = 0.02;          // [s]
  double energy_tolerance = 0.05;  // of energy_scale()
  double step_tolerance = 0.01;    // relative width of the final bisection interval
};

/// The energy [J] that a run can turn over: the weight of all bodies times the diagonal of their box, or the kinetic
/// energy that they start with where that is more; without either, the initial potential energy.
double energy_scale(const Structure& structure, const Forces& forces, const Eigen::Vector3d& gravity,
                    const State& initial);

/// True when the run with `options` is stable.
bool runs_stably(const Structure& structure, const Forces& forces, const SolverOptions& options, const State& initial,
                 double scale, const MeasurementOptions& measurement);

struct MeasuredStep {
  double step = 0.0;       // [s] the largest step found stable; 0 when none was
  bool unlimited = false;  // stable at `largest`, beyond which the search did not go
};

/// Climbs from 0.8 of `guess` [s] by a fifth each time to the first failure, at most `largest`, then bisects.
MeasuredStep measured_step(const Structure& structure, const Forces& forces, SolverOptions options,
                           const State& initial, double scale, double guess, double largest,
                           const MeasurementOptions& measurement);

}  // namespace billow::sim
