// Two runs side by side.
#include "cli/study/reference_error.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "sim/body/momenta.h"

namespace billow::cli {

namespace {

constexpr double sample_step = 0.05;  // [s]

double energy(const Simulation& simulation, const sim::State& state) {
  return sim::kinetic_energy(simulation.structure(), state) + simulation.forces().potential_energy(state);
}

}  // namespace

ReferenceError reference_error(const Simulation& simulation, const StepChoice& choice, const Simulation& reference,
                               double until) {
  const int n = simulation.structure().particles();
  if (reference.structure().particles() != n)
    throw InputError("the reference has other particles than the run; change only what leaves the meshes as they are");
  const auto solver = simulation.make_solver(choice), truth = reference.make_solver(reference.choose_step());
  ReferenceError error;
  double squares = 0.0;
  const int samples = static_cast<int>(std::floor(until / sample_step + 1e-9));
  for (int k = 0; k <= samples; ++k) {
    const double time = k * sample_step;
    const double square = (solver->sample(time).position - truth->sample(time).position).squaredNorm() / std::max(1, n);
    squares += square;
    error.worst = std::max(error.worst, std::sqrt(square));
  }
  error.rms = std::sqrt(squares / (samples + 1));
  error.energy = energy(simulation, solver->state());
  error.reference_energy = energy(reference, truth->state());
  return error;
}

}  // namespace billow::cli
