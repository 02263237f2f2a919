// Stepping, sampling between steps, and noticing divergence.
#include "sim/step/solver.h"

#include <fmt/format.h>
#include <cmath>

#include "base/error.h"

namespace billow::sim {

namespace {

// Steps between looks at every spring. Speeds are looked at after every step, so a blow-up is seen at once; this
// catches springs that creep apart.
constexpr int strain_check_interval = 16;

/// The most stretched spring; a strain that is not a number counts as infinite.
struct WorstSpring {
  int spring = 0;
  double strain = 0.0;
};

double length_of(const Structure& structure, const State& state, int spring) {
  return (state.position.row(structure.spring(spring, 1)) - state.position.row(structure.spring(spring, 0))).norm();
}

// In rest lengths, or in mean ones where a spring is shorter than these: a sliver's edge may well grow tenfold.
WorstSpring worst_spring(const Structure& structure, const State& state) {
  WorstSpring worst;
  for (const Body& body : structure.body)
    for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
      const double rest = structure.rest_length(s);
      double strain = (length_of(structure, state, s) - rest) / std::max(rest, body.mean_rest_length);
      if (!std::isfinite(strain)) strain = INFINITY;
      if (strain > worst.strain) worst = {s, strain};
    }
  return worst;
}

int fastest_particle(const State& state) {
  int fastest = 0;
  double most = -1.0;
  for (int i = 0; i < state.velocity.rows(); ++i) {
    const double speed = state.velocity.row(i).squaredNorm();
    if (!std::isfinite(speed)) return i;
    if (speed > most) most = speed, fastest = i;
  }
  return fastest;
}

/// "particle 12 of 'drape'", numbered as the body's mesh is.
std::string particle_name(const Structure& structure, int particle) {
  const Body& body = body_of(structure, particle);
  return fmt::format("particle {} of '{}'", particle - body.first_particle, body.name);
}

// x(t) between two states by the cubic that meets both ends' positions and velocities; v(t) linear.
State interpolated(const State& from, const State& to, double time) {
  const double h = to.time - from.time, t = (time - from.time) / h;
  const double a = t * t * (3.0 - 2.0 * t), b = t * (1.0 - t) * (1.0 - t) * h, c = -t * t * (1.0 - t) * h;
  return {(1.0 - a) * from.position + a * to.position + b * from.velocity + c * to.velocity,
          (1.0 - t) * from.velocity + t * to.velocity, time};
}

// Straight from one to the other: what hooks have kept apart at both ends is apart in between.
State on_line(const State& from, const State& to, double time) {
  const double t = (time - from.time) / (to.time - from.time);
  return {(1.0 - t) * from.position + t * to.position, (1.0 - t) * from.velocity + t * to.velocity, time};
}

}  // namespace

Solver::Phase::Phase(const Structure& structure, const Forces& the_forces, const SolverOptions& options,
                     const std::optional<FilterOptions>& filter_options, const std::vector<HookMaker>& hooks)
    : forces(the_forces),
      filter(filter_options ? std::make_optional<Filter>(structure, *filter_options) : std::nullopt),
      step(forces, options.method, options.integrator, filter ? &*filter : nullptr) {
  for (const HookMaker& make : hooks) step.add(make());
}

Solver::Solver(const Structure& structure, const Forces& forces, const SolverOptions& options, State initial)
    : structure_(structure),
      forces_(forces),
      options_(options),
      phase_(std::make_unique<Phase>(structure, forces, options, options.filter, options.hooks)),
      state_(std::move(initial)),
      previous_(state_),
      start_time_(state_.time) {
  if (!(options_.step > 0.0)) throw InputError("the time step must be positive");
  for (int i = 0; i < structure.particles(); ++i)
    if (structure.pinned(i)) state_.velocity.row(i).setZero();
}

// Which phase it is depends on the time alone, so that going back across a release needs no memory of it.
void Solver::enter_phase() {
  std::size_t due = 0;
  while (due < options_.releases.size() && options_.releases[due].time <= state_.time + 1e-9 * options_.step) ++due;
  if (due == released_) return;
  earlier_ += phase_->step.solve_counts();
  released_ = due;
  if (due == 0) {
    phase_ = std::make_unique<Phase>(structure_, forces_, options_, options_.filter, options_.hooks);
  } else {
    const Release& now = options_.releases[due - 1];
    phase_ = std::make_unique<Phase>(*now.structure, *now.forces, options_, now.filter, now.hooks);
  }
}

// Time is counted in the smallest steps there are; whole numbers of them times a power of two are exact.
void Solver::advance() {
  enter_phase();
  const Forces& forces = phase_->forces;
  const bool accounts = !forces.passive();
  if (accounts) before_ = state_;
  phase_->step(state_, step());
  ++steps_;
  ticks_ += ticks_per_step >> halvings_;
  state_.time = time_of(ticks_);
  if (accounts) work_ += forces.work(before_, state_);
  work_ += phase_->step.work();
  check_divergence();
}

void Solver::go_back(const Checkpoint& checkpoint) {
  state_ = checkpoint.state, previous_ = checkpoint.previous;
  ticks_ = checkpoint.ticks, steps_ = checkpoint.steps;
  work_ = checkpoint.work, largest_strain_ = checkpoint.largest_strain;
  looked_at_square_ = 0.0;
  phase_->step.forget();
}

// Speeds that come to a rest length a step and have doubled since springs were last looked at are suspect: what grows
// without end is looked at again and again, what merely falls is not.
void Solver::check_divergence() {
  const double speed_square = state_.velocity.squaredNorm();
  double reach = 0.0;
  for (const Body& body : structure_.body) reach = std::max(reach, body.mean_rest_length / step());
  const bool suspect = !(speed_square < std::max(reach * reach, 4.0 * looked_at_square_));
  if (!suspect && steps_ % strain_check_interval != 0) return;
  looked_at_square_ = speed_square;
  const double strain = worst_spring(structure_, state_).strain;
  largest_strain_ = std::max(largest_strain_, strain);
  if (!std::isfinite(speed_square) || !std::isfinite(state_.position.sum()) || strain > options_.max_strain)
    throw DivergenceError(divergence_text(advice()));
}

std::string Solver::divergence_text(const std::string& advice) const {
  const WorstSpring worst = worst_spring(structure_, state_);
  const int i = structure_.spring(worst.spring, 0), j = structure_.spring(worst.spring, 1);
  return fmt::format(
      "the simulation diverged at step {} (t = {:.4f} s): {} is the fastest; {} spring {} ({} to {}) is stretched by "
      "{:.3g} times its rest length; the step was {:.4g} s and {}",
      steps_, state_.time, particle_name(structure_, fastest_particle(state_)), name(structure_.kind[worst.spring]),
      worst.spring, particle_name(structure_, i), particle_name(structure_, j),
      length_of(structure_, state_, worst.spring) / structure_.rest_length(worst.spring) - 1.0, step(), advice);
}

std::string Solver::advice() const {
  const std::string scheme = fmt::format("{}{}", name(options_.method), options_.filter ? " with this filter" : "");
  if (!options_.limit) return fmt::format("{} has no known limit here; use a smaller step", scheme);
  if (*options_.limit <= 0.0)
    return fmt::format(
        "{} grows at every step here; use another method{} or add damping", scheme,
        options_.filter && options_.method != Method::forward_euler ? ", 'form: conserving', a larger lambda" : "");
  if (options_.step > *options_.limit)
    return fmt::format("the limit for {} is {:.4g} s; use 'step: auto' or a smaller step", scheme, *options_.limit);
  return fmt::format(
      "the limit for {} is {:.4g} s as long as springs keep about their lengths; use 'step: auto', 'watch: true' or a "
      "smaller step",
      scheme, *options_.limit);
}

SolveCounts Solver::solve_counts() const {
  SolveCounts counts = earlier_;
  return counts += phase_->step.solve_counts();
}

State Solver::sample(double time) {
  const double rounding = 1e-9 * step();
  while (state_.time < time - rounding) {
    // The last step, also when it ends at `time` itself: the next sample may go back into it.
    if (state_.time + 1.5 * step() > time) previous_ = state_;
    advance();
  }
  if (state_.time <= time + rounding) return state_;
  if (!phase_->step.hooked()) return interpolated(previous_, state_, time);
  return phase_->step.straight() ? on_line(previous_, state_, time) : state_;
}

}  // namespace billow::sim
