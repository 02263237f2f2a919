// A ring of springs, whose stiffness and filters share their modes: step limits in closed form.
#pragma once

#include <vector>

#include "sim/filter/filter_options.h"
#include "sim/limit/linear_force.h"
#include "tests/support/evaluations.h"
#include "tests/support/step_matrix.h"
#include "tests/support/structures.h"

namespace billow::test {

/// A ring whose springs act on each axis alike, f_i = k (x_{i-1} - 2 x_i + x_{i+1}): its stiffness and every filter are
/// circulant, so they share the modes cos(p theta i), theta = 2 pi / n.
class RingOfModes {
 public:
  static constexpr int n = 16;
  static constexpr double mass = 0.3, stiffness = 70.0;

  /// Of mode p [1/s].
  double omega(int p) const;
  /// The filter's response to mode p: neighbours at distance 1.
  double response(const sim::FilterOptions& options, int p) const;

  /// Spectral radius of the step in the plane of mode p, which it never leaves.
  double radius(const LinearStep& step, int p, double h) const;
  /// Largest h for which mode p does not grow; 0 if it grows at every step.
  double limit(const LinearStep& step, int p) const;

  sim::Structure structure = ring(n, mass, stiffness);
  sim::Linearisation linearisation = bound_of(structure, sim::Shapes::any);
  sim::Forces forces = sim::linear_forces(structure, linearisation);
};

/// Filters with a response above 0 to every mode of the ring.
std::vector<sim::FilterOptions> filters_that_pass_every_mode_upright(sim::FilterTarget target);

}  // namespace billow::test
