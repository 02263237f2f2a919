// The conditions of the table, each the largest eigenvalue of F (a A + b C - sigma I) as a function of h.
#include "sim/limit/exact_limit.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "sim/linear/arnoldi.h"
#include "sim/linear/lanczos.h"
#include "sim/step/implicit_part.h"

namespace billow::sim {

namespace {

/// F (stiffness A + damping C - shift I) <= most.
struct Condition {
  double stiffness = 0.0, damping = 0.0, shift = 0.0, most = 0.0;
};
using ConditionAt = std::function<Condition(double h)>;

// Relative accuracy of the eigenvalues and of the steps found from them.
constexpr double eigenvalue_tolerance = 1e-4, step_tolerance = 5e-5;
constexpr int most_iterations = 400;

// Steps beyond which no search goes, in units of 2 / sqrt(k0), and the smallest limit that is still of use.
constexpr double largest_tried = 40.0, smallest_tried = 1e-7, least_of_use = 1e-2;

// Growth that comes to less than this factor's logarithm within the run's duration is none.
constexpr double allowed_growth = 0.1;

constexpr double filter_tolerance = 1e-3;

bool filters_velocity(const LinearisedStep& step) {
  return step.filter && step.filter->options().target == FilterTarget::velocity;
}

/// (F + F*) / 2
class MeanFilter {
 public:
  MeanFilter(const LinearisedStep& step, const Filter* adjoint) : step_(step), adjoint_(adjoint) {}

  /// y = weight (F + F*) / 2 x
  void apply(const Eigen::MatrixX3d& x, double weight, Eigen::MatrixX3d& y) {
    y = x;
    step_.filter->apply(step_.position, 0.0, y, scratch_);
    if (adjoint_) {
      back_ = x;
      adjoint_->apply(step_.position, 0.0, back_, scratch_);
      y = 0.5 * (y + back_);
    }
    y *= weight;
  }

 private:
  const LinearisedStep& step_;
  const Filter* adjoint_;
  FilterScratch scratch_;
  Eigen::MatrixX3d back_;
};

/// Eigenvalues of F (a A + b C - sigma I).
class Spectrum {
 public:
  /// Of `step`, or of another damping in its place; F is the mean filter, where there is one.
  Spectrum(const LinearisedStep& step, const StiffnessMatrix& damping, std::optional<MeanFilter> filter)
      : step_(step),
        damping_(damping),
        filter_(std::move(filter)),
        damped_(!damping.is_zero()),
        inner_mass_(free_mass(step.structure)) {}

  bool damped() const { return damped_; }
  int found() const { return found_; }

  /// The largest one of the condition's. Its error is below `tolerance` of itself or of `scale`, whichever is larger.
  ExtremeEigenvalue largest(const Condition& c, double scale = 0.0) {
    return find(c, {.tolerance = eigenvalue_tolerance, .scale = scale, .max_iterations = most_iterations});
  }

  /// Whether it is at most `most`, where motions that nothing resists are at most right beside that.
  bool at_most(const Condition& c, double most, double scale) {
    constexpr double fine = 1e-5;
    constexpr int iterations = 150;
    return find(c, {.tolerance = fine, .scale = scale, .stop_above = most, .max_iterations = iterations}).value <= most;
  }

 private:
  ExtremeEigenvalue find(const Condition& c, const LanczosOptions& options) {
    ++found_;
    SymmetricProduct product{
        .outer = [this, c](const auto& x, auto& y) { multiply(c, x, y); }, .inner = {}, .inner_mass = inner_mass_};
    if (filter_) product.inner = [this](const auto& x, auto& y) { filter_->apply(x, 1.0, y); };
    return largest_eigenvalue(product, options);
  }

  void multiply(const Condition& c, const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
    y = -c.shift * x;
    if (c.stiffness != 0.0) add(step_.linearisation.stiffness, c.stiffness, x, y);
    if (c.damping != 0.0 && damped_) add(damping_, c.damping, x, y);
  }

  void add(const StiffnessMatrix& matrix, double weight, const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
    matrix.multiply(x, product_);
    y += weight * (step_.structure.inverse_mass.asDiagonal() * product_);
  }

  const LinearisedStep& step_;
  const StiffnessMatrix& damping_;
  std::optional<MeanFilter> filter_;
  bool damped_;
  Eigen::VectorXd inner_mass_;
  int found_ = 0;
  Eigen::MatrixX3d product_;
};

/// Where the conditions hold and where not any more.
class Limits {
 public:
  Limits(const LinearisedStep& step, const Filter* adjoint)
      : step_(step),
        adjoint_(adjoint),
        filters_velocity_(filters_velocity(step)),
        spectrum_(step, step.linearisation.damping, mean_filter()) {
    const double k0 = spectrum_.largest({.stiffness = 1.0}).upper();
    unit_ = k0 > 0.0 ? 2.0 / std::sqrt(k0) : INFINITY;
    if (spectrum_.damped()) c0_ = std::max(0.0, spectrum_.largest({.damping = 1.0}).upper());
  }

  /// Of the scheme; nothing where it has no closed form.
  std::optional<CertifiedStep> find() {
    if (std::isinf(unit_) && c0_ == 0.0) return limit_of(std::nullopt);
    switch (step_.method) {
      case Method::fb_euler:
      case Method::verlet:
        return limit_of(symplectic());
      case Method::forward_euler:
        return limit_of(forward_euler());
      case Method::rk4:
        return filters_velocity_ ? std::nullopt : std::make_optional(limit_of(runge_kutta()));
      case Method::backward_euler:
        return step_.filter ? std::nullopt : std::make_optional(limit_of(std::nullopt));
      case Method::imex:
        return step_.filter ? std::nullopt : std::make_optional(limit_of(imex()));
    }
    return std::nullopt;
  }

 private:
  std::optional<MeanFilter> mean_filter() const {
    return step_.filter ? std::make_optional<MeanFilter>(step_, adjoint_) : std::nullopt;
  }

  CertifiedStep limit_of(const std::optional<double>& step) const {
    return {step.value_or(0.0), !step, true, spectrum_.found()};
  }

  // What all searches begin with: about where the stiffness, or else the damping, sets the limit.
  double first_guess() const { return std::isinf(unit_) ? 2.0 / c0_ : unit_; }

  // By how much the condition is exceeded, as a share of what it allows.
  double excess(Spectrum& spectrum, const Condition& c) {
    const double allowed = c.most + c.shift;
    return (spectrum.largest(c, allowed).upper() - c.most) / allowed;
  }

  std::optional<double> root(Spectrum& spectrum, const ConditionAt& condition);
  std::optional<double> symplectic();
  std::optional<double> runge_kutta() const;
  std::optional<double> imex();
  std::optional<double> forward_euler();
  double without_gain();
  double before_overshoot(double most);

  const LinearisedStep& step_;
  const Filter* adjoint_;
  bool filters_velocity_;
  Spectrum spectrum_;
  double unit_ = INFINITY;  // 2 / sqrt(k0) [s], k0 of F A
  double c0_ = 0.0;         // [1/s] of F C
};

// The largest h up to which `condition` holds; none where it holds beyond all that is tried. First a bracket: below 0
// the excess says how far to go, as it nearly does above. Then the Illinois variant of the rule of false position.
std::optional<double> Limits::root(Spectrum& spectrum, const ConditionAt& condition) {
  double low = 0.0, high = INFINITY, low_excess = 0.0, high_excess = 0.0;
  for (double h = first_guess(); low == 0.0 || std::isinf(high);) {
    if (h > largest_tried * first_guess()) return std::nullopt;
    if (h < smallest_tried * first_guess()) return 0.0;
    const double now = excess(spectrum, condition(h));
    if (std::isnan(now)) return 0.0;
    if (now <= 0.0)
      low = h, low_excess = now, h *= now < -0.5 ? 1.5 : 1.02 / std::sqrt(1.0 + now);
    else
      high = h, high_excess = now, h *= 0.98 / (now > 1.0 ? 1.0 + now : std::sqrt(1.0 + now));
  }
  int side = 0;
  while (high - low > step_tolerance * high && low_excess < -step_tolerance) {
    const double share = std::clamp(low_excess / (low_excess - high_excess), 0.02, 0.98);
    const double h = low + share * (high - low), now = excess(spectrum, condition(h));
    if (now <= 0.0) {
      low = h, low_excess = now;
      if (side < 0) high_excess *= 0.5;
      side = -1;
    } else {
      high = h, high_excess = now;
      if (side > 0) low_excess *= 0.5;
      side = 1;
    }
  }
  return low;
}

std::optional<double> Limits::symplectic() {
  if (!filters_velocity_ && c0_ == 0.0) return unit_;
  const double shift = filters_velocity_ ? 2.0 : 0.0;
  return root(spectrum_, [&](double h) { return Condition{h * h, 2.0 * h, shift, 4.0 - shift}; });
}

// RK4's step of y' = z y.
double rk4_modulus(std::complex<double> z) {
  return std::abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))));
}

// Whether RK4 damps both solutions of z^2 + p z + q = 0.
bool rk4_damps(double p, double q) {
  constexpr double rounding = 1e-12;
  const std::complex<double> root = std::sqrt(std::complex<double>(0.25 * p * p - q));
  return rk4_modulus(-0.5 * p + root) <= 1.0 + rounding && rk4_modulus(-0.5 * p - root) <= 1.0 + rounding;
}

// All pairs up to (p, q): what a mode's Rayleigh quotients can be when only their largest values are known. The pairs
// that RK4 damps have no hole, so the rim tells.
bool rk4_damps_up_to(double p, double q) {
  constexpr int samples = 400;
  for (int k = 0; k <= samples; ++k) {
    const double share = static_cast<double>(k) / samples;
    if (!rk4_damps(share * p, q) || !rk4_damps(p, share * q)) return false;
  }
  return true;
}

/// The largest number up to `high` at which `holds`, which holds at every smaller one.
double last_that_holds(double high, const std::function<bool(double)>& holds) {
  if (holds(high)) return high;
  double low = 0.0;
  while (high - low > step_tolerance * high) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

std::optional<double> Limits::runge_kutta() const {
  const double by_stiffness = std::numbers::sqrt2 * unit_;
  if (c0_ == 0.0) return by_stiffness;
  const double k0 = std::isinf(unit_) ? 0.0 : 4.0 / (unit_ * unit_);
  return last_that_holds(std::min(by_stiffness, 3.0 / c0_),
                         [&](double h) { return rk4_damps_up_to(h * c0_, h * h * k0); });
}

// What IMEX takes explicitly is exceeded by twice what it takes implicitly, unless laws act that it does not know.
std::optional<double> Limits::imex() {
  Linearisation beyond(step_.structure);
  add_implicit_part(step_.structure, -2.0, 0.0, beyond.stiffness);
  add_implicit_part(step_.structure, 0.0, -2.0, beyond.damping);
  beyond.stiffness.add_scaled(step_.linearisation.stiffness, 1.0);
  beyond.damping.add_scaled(step_.linearisation.damping, 1.0);
  const LinearisedStep rest{step_.structure, beyond, step_.position, step_.method};
  Spectrum spectrum(rest, beyond.damping, std::nullopt);
  if (spectrum.largest({.damping = 1.0}, c0_).upper() <= 1e-3 * c0_ &&
      spectrum.largest({.stiffness = 1.0}, 4.0 / (unit_ * unit_)).upper() <= 1e-3 * 4.0 / (unit_ * unit_))
    return std::nullopt;
  return root(spectrum, [](double h) { return Condition{h * h, 2.0 * h, 0.0, 4.0}; });
}

// The largest h up to which forward Euler adds no more to any motion's energy than damping takes out: without a filter
// or with one of forces, which both suffer alike, a growth of (h a - c) / 2 a second; with one of velocities,
// (h^2 a - h c + 1) / p a step. 0 where that is too small to be of use.
double Limits::without_gain() {
  const StiffnessMatrix& damping = step_.least_damping ? *step_.least_damping : step_.linearisation.damping;
  const double rate = 2.0 * allowed_growth / step_.duration;
  Spectrum gains(step_, damping, filters_velocity_ ? mean_filter() : std::nullopt);
  const double k0 = 4.0 / (unit_ * unit_);
  const auto holds = [&](double h) {
    return filters_velocity_ ? gains.at_most({.stiffness = h * h, .damping = -h, .shift = -1.0}, 1.0 + rate * h, 1.0)
                             : gains.at_most({.stiffness = h, .damping = -1.0}, rate, h * k0);
  };
  return holds(least_of_use * unit_) ? last_that_holds(largest_tried * unit_, holds) : 0.0;
}

std::optional<double> Limits::forward_euler() {
  if (std::isinf(unit_)) return root(spectrum_, [](double h) { return Condition{0.0, 2.0 * h, 0.0, 4.0}; });
  const double limit = without_gain();
  return c0_ == 0.0 || limit == 0.0 ? limit : std::min(limit, before_overshoot(limit));
}

// The largest h up to `most` at which damping turns no motion around. What is stiff is turned around later, unless only
// a bound of the stiffness is known.
double Limits::before_overshoot(double most) {
  const double shift = filters_velocity_ ? 2.0 : 0.0;
  const double stiffness = step_.least_damping ? 0.0 : -1.0;
  const auto holds = [&](double h) {
    return excess(spectrum_, {stiffness * h * h, 2.0 * h, shift, 4.0 - shift}) <= 0.0;
  };
  double low = std::min(most, 2.0 / c0_);
  while (low < most) {
    const double next = std::min(1.1 * low, most);
    if (!holds(next)) return low + last_that_holds(next - low, [&](double more) { return holds(low + more); });
    low = next;
  }
  return low;
}

bool lets_all_pass_upright(const LinearisedStep& step, const Filter& adjoint) {
  MeanFilter mean(step, &adjoint);
  const auto negative = [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) { mean.apply(x, -1.0, y); };
  return largest_eigenvalue({negative, {}, free_mass(step.structure)}, {.tolerance = filter_tolerance, .scale = 1.0})
             .upper() <= 2.0 * filter_tolerance;
}

}  // namespace

std::optional<CertifiedStep> exact_limit(const LinearisedStep& step) {
  if (step.filter && (!is_explicit(step.method) || !step.filter->self_adjoint() || turns_motions_around(step)))
    return std::nullopt;
  // Sufficient only, and by far where A and C do not commute with F.
  if (step.method == Method::forward_euler && filters_velocity(step)) return std::nullopt;
  return Limits(step, nullptr).find();
}

std::optional<CertifiedStep> limit_of_mean_filter(const LinearisedStep& step) {
  const Filter adjoint = step.filter->adjoint();
  if (!lets_all_pass_upright(step, adjoint)) return std::nullopt;
  return Limits(step, &adjoint).find();
}

// An eigenvalue of F below 0 makes one of I - F larger than 1.
bool turns_motions_around(const LinearisedStep& step) {
  if (step.filter->nonnegative()) return false;
  MeanFilter filter(step, nullptr);
  const auto taken = [&](const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y) {
    filter.apply(x, -1.0, y);
    y += x;
  };
  constexpr int products = 120;
  return largest_modulus(taken, free_mass(step.structure),
                         {.max_iterations = products, .tolerance = 0.1 * filter_tolerance})
             .value > 1.0 + filter_tolerance;
}

}  // namespace billow::sim
