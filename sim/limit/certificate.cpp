// Trials of the linearised step, and the search over its size.
#include "sim/limit/certificate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/random.h"
#include "sim/limit/linear_force.h"
#include "sim/linear/power_method.h"
#include "sim/step/step.h"

namespace billow::sim {

namespace {

// Several evaluations of the forces make a step dear, and past its limit such a scheme grows fast.
int trial_steps(Method method, const CertificateOptions& certificate) {
  if (!is_explicit(method)) return certificate.implicit_steps;
  return scheme(method).evaluations > 1 ? certificate.steps / 2 : certificate.steps;
}

/// Runs the linearised step and says whether it grows.
class Trial {
 public:
  Trial(const Structure& structure, const Linearisation& linearisation, const Eigen::MatrixX3d& position, Method method,
        const IntegratorOptions& options, const Filter* filter, const CertificateOptions& certificate)
      : steps_(trial_steps(method, certificate)),
        forces_(linear_forces(structure, linearisation)),
        step_(forces_, method, nearly_exact(options), filter, &position) {
    Eigen::MatrixX3d mode;
    const double k0 = max_eigenvalue(structure, linearisation.stiffness, {.tolerance = 1e-8}, &mode).value;
    omega_ = std::sqrt(std::max(k0, 0.0));
    noise_ = structure.inverse_mass.cwiseSign().asDiagonal() * seeded_noise(structure.particles(), certificate.seed);
    noise_ /= std::max(noise_.norm(), 1e-300);
    // Velocities too, for the motions that damping alone acts on. So little that the drift of those on which nothing
    // acts stays below the rest.
    start_ = {mode / std::max(mode.norm(), 1e-300) + noise_, 1e-3 * omega_ * noise_, 0.0};
  }

  /// sqrt(k0) [1/s]
  double omega() const { return omega_; }

  /// `share` of the full number of steps: enough where growth, if any, is fast.
  bool stable(double h, double share) {
    const int steps = static_cast<int>(share * steps_);
    State state = start_;
    const double begin = norm(state);
    double earlier = 0.0, later = 0.0, now = begin;  // largest norms of the second and the last quarter
    for (int k = 1; k <= steps; ++k) {
      step_(state, h);
      now = norm(state);
      if (!(now < 1e9 * begin)) return remember_growth(state, now), false;
      if (4 * k > steps && 2 * k <= steps) earlier = std::max(earlier, now);
      if (4 * k > 3 * steps) later = std::max(later, now);
    }
    const bool grows = later > std::numbers::e * earlier && later > 1e-6 * begin;
    if (grows) remember_growth(state, now);
    return !grows;
  }

 private:
  // The linear solves must be close to exact for the step to be close to a linear operator.
  static IntegratorOptions nearly_exact(IntegratorOptions options) {
    options.tolerance = 1e-6;
    return options;
  }

  // Displacements and velocities on one scale: v / omega is a length.
  double norm(const State& state) const {
    return std::sqrt(state.position.squaredNorm() + state.velocity.squaredNorm() / (omega_ * omega_));
  }

  // What grew at one step is the best place to look for growth at a smaller one.
  void remember_growth(const State& state, double size) {
    if (!std::isfinite(size) || size == 0.0) return;
    start_.position = state.position / size + 0.1 * noise_;
    start_.velocity = state.velocity / size;
  }

  int steps_;
  Forces forces_;
  Step step_;
  double omega_ = 0.0;
  Eigen::MatrixX3d noise_;
  State start_;
};

// Steps in units of 2/sqrt(k0), where the search begins and where it gives up. Below `smallest` the growth tolerance
// would hide that forward Euler grows at every step: it grows by (omega h)^2 / 2, which reaches the tolerance of 4/1000
// at 0.045.
constexpr double first_explicit = 0.4, first_implicit = 0.5, least_tried = 0.04, smallest = 0.08, largest = 40.0;

// Shares of the full number of steps: short trials bracket the limit within a few percent, full ones settle it.
// Implicit trials are short enough already.
constexpr double short_trial = 0.3, full_trial = 1.0;

/// The search for the largest stable step. Explicit schemes have limits of about 2/sqrt(k0), which the search meets in
/// small steps; implicit ones seldom have any.
class Search {
 public:
  Search(Trial& trial, bool is_explicit, double tolerance)
      : trial_(trial), explicit_(is_explicit), tolerance_(tolerance), unit_(2.0 / trial.omega()) {}

  CertifiedStep run() {
    const double bracketing = explicit_ ? short_trial : full_trial;
    if (!descend(bracketing)) return {0.0, false, trials_};
    if (!climb(bracketing)) return {low_, true, trials_};
    bisect(bracketing);
    if (explicit_ && !holds(low_) && !retreat()) return {0.0, false, trials_};
    return {low_ < smallest * unit_ ? 0.0 : low_, false, trials_};
  }

 private:
  bool stable(double h, double share) { return ++trials_, trial_.stable(h, share); }

  // To a first step that does not grow.
  bool descend(double share) {
    high_ = (explicit_ ? first_explicit : first_implicit) * unit_;
    while (high_ > least_tried * unit_ && !stable(high_, share)) high_ *= 0.5;
    return high_ >= smallest * unit_;
  }

  // From there to one that does: the limit is between low and high.
  bool climb(double share) {
    do {
      low_ = high_;
      high_ *= !explicit_ ? 4.0 : low_ < 0.7 * unit_ ? 2.0 : 1.3;
      if (high_ > largest * unit_) return false;
    } while (stable(high_, share));
    return true;
  }

  void bisect(double share) {
    while (high_ - low_ > tolerance_ * high_) {
      const double middle = 0.5 * (low_ + high_);
      (stable(middle, share) ? low_ : high_) = middle;
    }
  }

  // A short trial can miss slow growth, so the answer must pass a full one before it is believed. So must smaller
  // steps: RK4 damps at large steps what grows slowly at small ones.
  bool holds(double h) { return stable(h, full_trial) && stable(0.75 * h, full_trial) && stable(0.5 * h, full_trial); }

  // Back to a step that holds, and from there by full trials.
  bool retreat() {
    do {
      high_ = low_;
      low_ *= 0.9;
      if (low_ < smallest * unit_) return false;
    } while (!holds(low_));
    bisect(full_trial);
    return true;
  }

  Trial& trial_;
  bool explicit_;
  double tolerance_, unit_;
  double low_ = 0.0, high_ = 0.0;  // [s] stable and unstable
  int trials_ = 0;
};

}  // namespace

CertifiedStep certified_step(const Structure& structure, const Linearisation& linearisation,
                             const Eigen::MatrixX3d& position, Method method, const IntegratorOptions& options,
                             const Filter* filter, const CertificateOptions& certificate) {
  Trial trial(structure, linearisation, position, method, options, filter, certificate);
  if (trial.omega() == 0.0) return {0.0, true, 0};
  if (!std::isfinite(trial.omega()))
    throw InputError("stiffness over mass is beyond what a step can be found for; check masses and stiffnesses");
  return Search(trial, is_explicit(method), certificate.step_tolerance).run();
}

}  // namespace billow::sim
