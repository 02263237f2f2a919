// Trials of the linearised step, and the search over its size.
#include "sim/certificate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/error.h"
#include "sim/filtered_step.h"
#include "sim/power_method.h"
#include "sim/random.h"

namespace billow::sim {

namespace {

/// f = -K x - C v, where the state's positions are displacements.
class LinearForce : public ForceTerm {
 public:
  explicit LinearForce(const Structure& structure, const Linearisation& linearisation)
      : linearisation_(linearisation), damped_(structure.damping.maxCoeff() > 0.0) {
    for (const Body& body : structure.body) damped_ = damped_ || body.friction > 0.0;
  }
  void add_force(const State& state, Eigen::MatrixX3d& force) const override {
    linearisation_.stiffness.multiply(state.position, product_);
    force -= product_;
    if (!damped_) return;
    linearisation_.damping.multiply(state.velocity, product_);
    force -= product_;
  }
  void add_linearisation(const State&, double position_weight, double velocity_weight, JacobianForm,
                         StiffnessMatrix& matrix) const override {
    matrix.add_scaled(linearisation_.stiffness, position_weight);
    matrix.add_scaled(linearisation_.damping, velocity_weight);
  }

 private:
  const Linearisation& linearisation_;
  bool damped_;
  mutable Eigen::MatrixX3d product_;
};

// RK4's four evaluations make a step dear, and past its limit it grows fast.
int trial_steps(Method method, const CertificateOptions& certificate) {
  if (!is_explicit(method)) return certificate.implicit_steps;
  return method == Method::rk4 ? certificate.steps / 2 : certificate.steps;
}

/// Runs the linearised step and says whether it grows.
class Trial {
 public:
  Trial(const Structure& structure, const Linearisation& linearisation, const Eigen::MatrixX3d& position, Method method,
        const IntegratorOptions& options, const Filter* filter, const CertificateOptions& certificate)
      : steps_(trial_steps(method, certificate)), forces_(structure, terms(structure, linearisation)) {
    // The linear solves must be close to exact for the step to be close to a linear operator.
    IntegratorOptions exact = options;
    exact.tolerance = 1e-6;
    step_.emplace(structure, forces_, method, exact, filter, &position);
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
      (*step_)(state, h);
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
  static std::vector<std::unique_ptr<ForceTerm>> terms(const Structure& structure, const Linearisation& linearisation) {
    std::vector<std::unique_ptr<ForceTerm>> list;
    list.push_back(std::make_unique<LinearForce>(structure, linearisation));
    return list;
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
  std::optional<FilteredStep> step_;
  double omega_ = 0.0;
  Eigen::MatrixX3d noise_;
  State start_;
};

}  // namespace

namespace {

// The share of 2/sqrt(k0) below which the growth tolerance would hide that forward Euler grows at every step: it grows
// by (omega h)^2 / 2, which reaches the tolerance of 4/1000 at 0.045 of it.
constexpr double smallest = 0.08;

}  // namespace

CertifiedStep certified_step(const Structure& structure, const Linearisation& linearisation,
                             const Eigen::MatrixX3d& position, Method method, const IntegratorOptions& options,
                             const Filter* filter, const CertificateOptions& certificate) {
  Trial trial(structure, linearisation, position, method, options, filter, certificate);
  CertifiedStep result;
  if (trial.omega() == 0.0) return {0.0, true, 0};
  if (!std::isfinite(trial.omega()))
    throw InputError("stiffness over mass is beyond what a step can be found for; check masses and stiffnesses");
  const double unit = 2.0 / trial.omega();
  const auto stable = [&](double h, double share) { return ++result.trials, trial.stable(h, share); };
  // Explicit schemes have limits of about 2/sqrt(k0), which the search meets in small steps; implicit ones seldom have
  // any. Short trials bracket the limit within a few percent, full ones settle it.
  const bool fine = is_explicit(method);
  const double coarse = fine ? 0.3 : 1.0;
  double low = 0.0, high = (fine ? 0.4 : 0.5) * unit;
  while (high > 0.04 * unit && !stable(high, coarse)) high *= 0.5;
  if (high < smallest * unit) return {0.0, false, result.trials};
  do {
    low = high;
    high *= !fine ? 4.0 : low < 0.7 * unit ? 2.0 : 1.3;
    if (high > 40.0 * unit) return {low, true, result.trials};
  } while (stable(high, coarse));
  const auto bisect = [&](double share) {
    while (high - low > certificate.step_tolerance * high) {
      const double middle = 0.5 * (low + high);
      (stable(middle, share) ? low : high) = middle;
    }
  };
  // A short trial can miss slow growth, so the answer must pass a full one before it is believed. So must smaller
  // steps: RK4 damps at large steps what grows slowly at small ones.
  const auto holds = [&](double h) { return stable(h, 1.0) && stable(0.75 * h, 1.0) && stable(0.5 * h, 1.0); };
  bisect(coarse);
  if (fine && !holds(low)) {
    do {
      high = low;
      low *= 0.9;
      if (low < smallest * unit) return {0.0, false, result.trials};
    } while (!holds(low));
    bisect(1.0);
  }
  result.step = low < smallest * unit ? 0.0 : low;
  return result;
}

}  // namespace billow::sim
