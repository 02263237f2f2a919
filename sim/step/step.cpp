// The stations of a step, one after another.
#include "sim/step/step.h"

#include <algorithm>

#include "base/error.h"
#include "base/huge_pages.h"

namespace billow::sim {

namespace {

PlacedFilter filter_of(FilterTarget target, const Filter* filter, const Eigen::MatrixX3d* frozen_position) {
  return {filter && filter->options().target == target ? filter : nullptr, frozen_position};
}

}  // namespace

Step::Step(const Forces& forces, Method method, const IntegratorOptions& options, const Filter* filter,
           const Eigen::MatrixX3d* frozen_position)
    : forces_(forces, filter_of(FilterTarget::force, filter, frozen_position)),
      integrator_(scheme(method).make(options)),
      velocity_filter_(filter_of(FilterTarget::velocity, filter, frozen_position)) {
  if (filter && filter->options().target == FilterTarget::force && !is_explicit(method))
    throw InputError("a force filter needs an explicit method; use 'target: velocity', or no filter, with " +
                     std::string(name(method)));
}

// Where nothing comes between them, filter and move are one pass over memory.
void Step::operator()(State& state, double h) {
  if (!prepared_) use_huge_pages(state.position), use_huge_pages(state.velocity);
  prepared_ = true;
  const double time = state.time;
  for (const auto& hook : hooks_) hook->begin(state, h);
  const Move move = integrator_->integrate(forces_, state, h, velocity_);  // forces -> integrate
  if (velocity_filter_ && hooks_.empty() && move.by_old == 0.0 && move.by_new != 0.0) {
    velocity_filter_->apply_and_move(velocity_filter_.position(state), time, velocity_, move.by_new, state.velocity,
                                     state.position, scratch_);
  } else {
    if (velocity_filter_) velocity_filter_->apply(velocity_filter_.position(state), time, velocity_, scratch_);
    for (const auto& hook : hooks_) hook->apply(state, move, velocity_);
    finish(state, move);
  }
  state.time = time + h;
  for (const auto& hook : hooks_) hook->end(state);
}

void Step::forget() {
  integrator_->forget();
  for (const auto& hook : hooks_) hook->forget();
}

bool Step::straight() const {
  return std::all_of(hooks_.begin(), hooks_.end(), [](const auto& hook) { return hook->straight(); });
}

double Step::work() const {
  double sum = 0.0;
  for (const auto& hook : hooks_) sum += hook->work();
  return sum;
}

void Step::finish(State& state, const Move& move) {
  if (move.by_old != 0.0) sim::move(state, move.by_old);
  state.velocity.swap(velocity_);
  if (move.by_new != 0.0) sim::move(state, move.by_new);
}

}  // namespace billow::sim
