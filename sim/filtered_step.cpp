// Where the filter meets the scheme.
#include "sim/filtered_step.h"

#include "sim/error.h"
#include "sim/huge_pages.h"

namespace billow::sim {

namespace {

/// Another Forces with its accelerations filtered. A constant field passes unchanged, so gravity does too.
class FilteredForces : public Forces {
 public:
  FilteredForces(const Forces& inner, const Filter& filter, const Eigen::MatrixX3d* frozen_position)
      : Forces(inner.structure(), std::vector<std::unique_ptr<ForceTerm>>{}),
        inner_(inner),
        filter_(filter),
        frozen_position_(frozen_position) {}

  void evaluate(const State& state, Eigen::MatrixX3d& force) const override { inner_.evaluate(state, force); }
  void acceleration(const State& state, Eigen::MatrixX3d& acceleration) const override {
    inner_.acceleration(state, acceleration);
    filter_.apply(frozen_position_ ? *frozen_position_ : state.position, state.time, acceleration);
  }
  void kick(const State& state, double h, Eigen::MatrixX3d& velocity) const override {
    inner_.acceleration(state, acceleration_);
    filter_.apply_and_kick(frozen_position_ ? *frozen_position_ : state.position, state.time, acceleration_,
                           state.velocity, h, velocity);
  }

 private:
  const Forces& inner_;
  const Filter& filter_;
  const Eigen::MatrixX3d* frozen_position_;
  mutable Eigen::MatrixX3d acceleration_;  // room that is kept from step to step
};

/// A filter of the velocities at the time of the step that is being taken.
class FilteredVelocities : public VelocityFilter {
 public:
  FilteredVelocities(const Filter& filter, const double& time, const Eigen::MatrixX3d* frozen_position)
      : filter_(filter), time_(time), frozen_position_(frozen_position) {}

  void apply(const Eigen::MatrixX3d& position, Eigen::MatrixX3d& velocity) const override {
    filter_.apply(frozen_position_ ? *frozen_position_ : position, time_, velocity);
  }
  void apply_and_move(Eigen::MatrixX3d& velocity, State& state, double h) const override {
    filter_.apply_and_move(frozen_position_ ? *frozen_position_ : state.position, time_, velocity, h, state.velocity,
                           state.position);
  }

 private:
  const Filter& filter_;
  const double& time_;
  const Eigen::MatrixX3d* frozen_position_;
};

}  // namespace

FilteredStep::FilteredStep(const Structure& structure, const Forces& forces, Method method,
                           const IntegratorOptions& options, const Filter* filter,
                           const Eigen::MatrixX3d* frozen_position)
    : structure_(structure), forces_(forces), integrator_(make_integrator(method, options)) {
  if (!filter) return;
  if (filter->options().target == FilterTarget::velocity) {
    velocity_filter_ = std::make_unique<FilteredVelocities>(*filter, time_, frozen_position);
  } else if (is_explicit(method)) {
    filtered_forces_ = std::make_unique<FilteredForces>(forces, *filter, frozen_position);
  } else {
    throw InputError("a force filter needs an explicit method; use 'target: velocity', or no filter, with " +
                     std::string(name(method)));
  }
}

FilteredStep::~FilteredStep() = default;

void FilteredStep::operator()(State& state, double h) {
  time_ = state.time;
  if (!prepared_) use_huge_pages(state.position), use_huge_pages(state.velocity);
  prepared_ = true;
  integrator_->step(structure_, filtered_forces_ ? *filtered_forces_ : forces_, state, h, velocity_filter_.get());
}

}  // namespace billow::sim
