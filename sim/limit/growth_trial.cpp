// Linear steps, and their energy from quarter to quarter.
#include "sim/limit/growth_trial.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "sim/limit/linear_force.h"
#include "sim/linear/max_eigenvalue.h"

namespace billow::sim {

namespace {

// The linear solves must be close to exact for the step to be close to a linear operator.
IntegratorOptions nearly_exact(IntegratorOptions options) {
  options.tolerance = 1e-6;
  return options;
}

// In a trial of n steps, growth by a factor of e^(4/n) a step comes to e^2 over its second half, and to more than e
// even where it begins as a small part of the whole.
constexpr double growth_seen = 4.0;

// Particles times evaluations times steps of the longest trial. Implicit steps are taken for fifty products each.
constexpr double longest_work = 1.5e6, implicit_evaluations = 50.0;
constexpr double fewest_explicit = 150.0, fewest_implicit = 40.0, most_steps = 6000.0;

int trial_steps(const LinearisedStep& step, double h, double most_growth) {
  const double evaluations = is_explicit(step.method) ? scheme(step.method).evaluations : implicit_evaluations;
  const double fewest = is_explicit(step.method) ? fewest_explicit : fewest_implicit;
  const double affordable = longest_work / (evaluations * step.structure.particles());
  return static_cast<int>(
      std::clamp(growth_seen / (most_growth * h), fewest, std::clamp(affordable, fewest, most_steps)));
}

// Energies are looked at every few steps; an odd number, so that what turns around at every step shows both its faces.
constexpr int look_interval = 5;

}  // namespace

GrowthTrial::GrowthTrial(const LinearisedStep& step, std::uint64_t seed)
    : step_(step),
      forces_(linear_forces(step.structure, step.linearisation)),
      run_(forces_, step.method, nearly_exact(step.options), step.filter, &step.position) {
  Eigen::MatrixX3d mode;
  const double k0 = max_eigenvalue(step.structure, step.linearisation.stiffness, {.tolerance = 1e-4}, &mode).value;
  omega_ = std::sqrt(std::max(k0, 0.0));
  noise_ = step.structure.inverse_mass.cwiseSign().asDiagonal() * seeded_noise(step.structure.particles(), seed);
  noise_ /= std::max(noise_.norm(), 1e-300);
  start_ = {mode / std::max(mode.norm(), 1e-300) + noise_, 0.1 * omega_ * noise_, 0.0};
}

// The energy, not a norm of the state: a free body that drifts does not grow.
double GrowthTrial::energy(const State& state) {
  step_.linearisation.stiffness.multiply(state.position, product_);
  return 0.5 * (state.position.cwiseProduct(product_).sum() +
                state.velocity.rowwise().squaredNorm().dot(free_mass(step_.structure)));
}

bool GrowthTrial::stable(double h, double most_growth) {
  const int steps = trial_steps(step_, h, most_growth);
  State state = start_;
  const double begin = energy(state);
  double earlier = 0.0, later = 0.0, now = begin;  // the largest energies of the second and of the last quarter
  for (int k = 1; k <= steps; ++k) {
    run_(state, h);
    if (k % look_interval != 0 && k != steps) continue;
    now = energy(state);
    if (!(now < 1e18 * begin)) {
      growth_ = std::log(1e9) / (k * h);
      resolved_ = true;
      return remember(state, now), false;
    }
    if (4 * k > steps && 2 * k <= steps) earlier = std::max(earlier, now);
    if (4 * k > 3 * steps) later = std::max(later, now);
  }
  const double amplitude = 0.5 * std::log(std::max(later, 1e-300) / std::max(earlier, 1e-300));
  growth_ = amplitude / (0.5 * steps * h);
  resolved_ = amplitude > 0.5;
  // Twofold at most for a double eigenvalue on the unit circle; what has all but died out grows from rounding.
  const bool grows = amplitude > std::max(1.0, 0.25 * most_growth * h * steps) && later > 1e-12 * begin;
  if (grows) remember(state, now);
  return !grows;
}

// What grew at one step is the best place to look for growth at a smaller one.
void GrowthTrial::remember(const State& state, double energy) {
  if (!std::isfinite(energy) || energy <= 0.0) return;
  const double size = std::sqrt(state.position.squaredNorm() + state.velocity.squaredNorm() / (omega_ * omega_));
  if (!std::isfinite(size) || size == 0.0) return;
  start_.position = state.position / size + 0.01 * noise_;
  start_.velocity = state.velocity / size;
}

}  // namespace billow::sim
