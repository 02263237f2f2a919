// Closed forms first; otherwise trials of the linearised step, and the search over its size.
#include "sim/limit/certificate.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "sim/limit/exact_limit.h"
#include "sim/limit/growth_trial.h"

namespace billow::sim {

namespace {

// Trials that only bracket the limit let so many times as fast growth pass: they are short.
constexpr double bracketing = 4.0;

// Implicit schemes seldom have a limit, and trials of them are dear.
constexpr double implicit_tolerance = 0.03;

// Steps in units of 2/sqrt(k0): where the search begins, and where it gives up.
constexpr double first_explicit = 0.4, first_implicit = 0.5, smallest = 0.01, largest = 40.0;

/// The search for the largest stable step. Explicit schemes have limits of about 2/sqrt(k0), which the search meets in
/// small steps; implicit ones seldom have any.
class Search {
 public:
  Search(GrowthTrial& trial, const LinearisedStep& step, const CertificateOptions& options)
      : trial_(trial),
        explicit_(is_explicit(step.method)),
        evaluations_(scheme(step.method).evaluations),
        tolerance_(explicit_ ? options.step_tolerance : std::max(options.step_tolerance, implicit_tolerance)),
        unit_(2.0 / trial.omega()),
        most_growth_(options.tolerated_growth / step.duration) {}

  /// From `guess` [s], which may be 0 for none, down to what holds; or up and down.
  CertifiedStep run(double guess) {
    CertifiedStep found = guess > 0.0 ? around(guess) : find();
    found.always_grows = always_grows_;
    return found;
  }

  /// Where motions are turned around every step grows, by about as much less a second as it is smaller: from the limit
  /// but for that, down.
  CertifiedStep down_to_slow_growth() {
    const CertifiedStep otherwise = find();
    double h = otherwise.step > 0.0 && !otherwise.unlimited ? otherwise.step
                                                            : (explicit_ ? first_explicit : first_implicit) * unit_;
    double wanted = h;
    for (; h > smallest * unit_; h = std::max(wanted, 0.3 * h)) {  // in strides that leave the growth to be seen
      const double now = growth(h);
      if (now <= most_growth_) return at(h);
      if (!trial_.resolved()) return at(wanted < smallest * unit_ ? 0.0 : wanted);
      wanted = 0.8 * h * most_growth_ / now;
    }
    return at(0.0);
  }

 private:
  bool stable(double h, double growth) { return ++trials_, trial_.stable(h, growth); }
  bool brackets(double h) { return stable(h, bracketing * most_growth_); }
  double growth(double h) { return stable(h, most_growth_), trial_.growth(); }

  // Damping, turned forces and the schemes themselves grow half as fast or slower at half the step. What grows as fast
  // is the motion itself, the filter's doing: a step has to hold but for that.
  bool tolerate_what_no_step_mends(double h) {
    const double whole = growth(h);
    if (always_grows_ || !trial_.resolved() || !(whole > most_growth_)) return false;
    const double half = growth(0.5 * h);
    if (!trial_.resolved() || !(half > 0.7 * whole)) return false;
    most_growth_ = 2.0 * std::max(whole, half);
    return always_grows_ = true;
  }

  // RK4 damps at large steps what grows slowly at small ones.
  bool holds(double h) {
    return stable(h, most_growth_) &&
           (evaluations_ == 1 || (stable(0.75 * h, most_growth_) && stable(0.5 * h, most_growth_)));
  }

  CertifiedStep at(double h) const { return {.step = h, .trials = trials_}; }

  CertifiedStep find() {
    low_ = 0.0;
    high_ = (explicit_ ? first_explicit : first_implicit) * unit_;
    while (high_ > smallest * unit_ && !brackets(high_)) high_ *= 0.5;
    if (high_ < smallest * unit_) return at(0.0);
    if (!climb()) return {.step = low_, .unlimited = true, .trials = trials_};
    bisect(bracketing);
    return holds(low_) ? at(low_) : retreat();
  }

  // Down from a guess that does not hold; up from one that leaves room.
  CertifiedStep around(double guess) {
    constexpr double room = 1.02;
    low_ = guess;
    if (!holds(guess)) return retreat();
    high_ = room * guess;
    if (!brackets(high_)) return at(guess);
    if (!climb()) return at(guess);
    bisect(bracketing);
    return holds(low_) ? at(low_) : retreat();
  }

  // From a step that does not grow to one that does: the limit is between low and high.
  bool climb() {
    do {
      low_ = high_;
      high_ *= !explicit_ ? 4.0 : low_ < 0.7 * unit_ ? 2.0 : 1.3;
      if (high_ > largest * unit_) return false;
    } while (brackets(high_));
    return true;
  }

  void bisect(double leniency) {
    while (high_ - low_ > tolerance_ * high_) {
      const double middle = 0.5 * (low_ + high_);
      (stable(middle, leniency * most_growth_) ? low_ : high_) = middle;
    }
  }

  // Back to a step that holds, in growing strides, and from there by full trials.
  CertifiedStep retreat() {
    if (tolerate_what_no_step_mends(0.5 * low_) && holds(low_)) return at(low_);
    double stride = 0.97;
    do {
      high_ = low_;
      low_ *= stride;
      stride = std::max(0.5, stride * stride);
      if (low_ < smallest * unit_) return at(0.0);
    } while (!holds(low_));
    tolerance_ = std::max(tolerance_, 0.1 * (high_ - low_) / high_);
    bisect(1.0);
    return at(low_);
  }

  GrowthTrial& trial_;
  bool explicit_;
  int evaluations_;
  double tolerance_, unit_, most_growth_;  // -, [s], [1/s]
  double low_ = 0.0, high_ = 0.0;          // [s] stable and unstable
  bool always_grows_ = false;
  int trials_ = 0;
};

CertifiedStep smaller(const CertifiedStep& a, const CertifiedStep& b) {
  CertifiedStep least = a.unlimited || (!b.unlimited && b.step < a.step) ? b : a;
  least.trials = a.trials + b.trials;
  least.always_grows = a.always_grows || b.always_grows;
  return least;
}

// What the search begins at: the limit of the mean filter. 0 for none.
double first_guess(const LinearisedStep& step) {
  if (!is_explicit(step.method)) return 0.0;
  const std::optional<CertifiedStep> mean = limit_of_mean_filter(step);
  return mean ? mean->step : 0.0;
}

// Whether stiffness over mass, summed over a particle's springs, stays a number.
bool is_finite(const Structure& structure) {
  if (!structure.inverse_mass.allFinite()) return false;
  const double stiffest = structure.springs() > 0 ? structure.stiffness.maxCoeff() : 0.0;
  return std::isfinite(4.0 * structure.springs() * stiffest * structure.inverse_mass.maxCoeff());
}

CertifiedStep certified_with_constant_filter(const LinearisedStep& step, const CertificateOptions& options) {
  if (!is_finite(step.structure))
    throw InputError("stiffness over mass is beyond what a step can be found for; check masses and stiffnesses");
  if (const auto exact = exact_limit(step)) return *exact;
  GrowthTrial trial(step, options.seed);
  if (trial.omega() == 0.0) return {.unlimited = true};
  Search search(trial, step, options);
  if (!turns_motions_around(step)) return search.run(first_guess(step));
  return step.filter->options().target == FilterTarget::force ? CertifiedStep{} : search.down_to_slow_growth();
}

}  // namespace

CertifiedStep certified_step(const LinearisedStep& step, const CertificateOptions& options) {
  if (!step.filter || step.filter->constant_weights()) return certified_with_constant_filter(step, options);
  CertifiedStep least{.unlimited = true};
  LinearisedStep constant = step;
  for (const double time : times_of_extremes(step.filter->options(), step.duration)) {
    const Filter filter = step.filter->frozen(time);
    constant.filter = &filter;
    least = smaller(least, certified_with_constant_filter(constant, options));
  }
  if (step.filter->options().distances == FilterDistances::rest) return least;
  constant.filter = nullptr;
  return smaller(least, certified_with_constant_filter(constant, options));
}

}  // namespace billow::sim
