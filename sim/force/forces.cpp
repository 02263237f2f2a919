// The sum of the laws of force: in one sweep over the springs as far as they join it.
#include "sim/force/forces.h"

#include <algorithm>

#include "base/huge_pages.h"
#include "sim/force/fluid_friction.h"
#include "sim/force/gravity.h"
#include "sim/force/spring_force.h"

namespace billow::sim {

namespace {

void make_room(const Structure& structure, Eigen::MatrixX3d& field) {
  if (field.rows() == structure.particles()) return;
  field.resize(structure.particles(), 3);
  use_huge_pages(field);
}

// force -> what is wanted of it.
void apply_yield(const Structure& structure, const State& state, const Yield& yield, Eigen::MatrixX3d& field) {
  if (yield.kind == Yield::Kind::force) return;
  for (int axis = 0; axis < 3; ++axis) field.col(axis).array() *= structure.inverse_mass.array();
  if (yield.kind == Yield::Kind::velocity) field = state.velocity + yield.step * field;
}

// The same as a sink of the springs' sweep.
SpringSink sink_for(const Structure& structure, const State& state, const Yield& yield, const FusedSweep& sweep,
                    Eigen::MatrixX3d& out) {
  SpringSink sink;
  sink.mass = structure.mass.data();
  if (yield.kind != Yield::Kind::force) sink.inverse_mass = structure.inverse_mass.data();
  sink.step = yield.step;
  for (int axis = 0; axis < 3; ++axis) {
    sink.out[axis] = out.col(axis).data();
    sink.velocity[axis] = state.velocity.col(axis).data();
    sink.gravity[axis] = sweep.gravity(axis);
    if (yield.kind == Yield::Kind::velocity) sink.base[axis] = state.velocity.col(axis).data();
  }
  return sink;
}

}  // namespace

Forces::Forces(const Structure& structure, const Eigen::Vector3d& gravity) : structure_(structure) {
  add(std::make_unique<SpringForce>(structure));
  add(std::make_unique<FluidFriction>(structure));
  add(std::make_unique<Gravity>(structure, gravity));
  use_huge_pages(structure.mass), use_huge_pages(structure.inverse_mass);
}

void Forces::add(std::unique_ptr<ForceLaw> law) {
  if (!law->join(sweep_)) outside_.push_back(law.get());
  laws_.push_back(std::move(law));
}

void Forces::evaluate(const State& state, const Yield& yield, Eigen::MatrixX3d& out, ForceScratch& scratch) const {
  make_room(structure_, out);
  if (sweep_.springs) return sweep(state, yield, out, scratch);
  sum_laws(state, out);
  apply_yield(structure_, state, yield, out);
}

void Forces::sum_laws(const State& state, Eigen::MatrixX3d& force) const {
  force.setZero();
  for (const auto& law : laws_) law->add_force(state, force);
}

// Springs, friction, gravity and masses in one pass over memory; what else acts is summed before it.
void Forces::sweep(const State& state, const Yield& yield, Eigen::MatrixX3d& out, ForceScratch& scratch) const {
  SpringSink sink = sink_for(structure_, state, yield, sweep_, out);
  if (!outside_.empty()) {
    scratch.applied.setZero(structure_.particles(), 3);
    for (const ForceLaw* law : outside_) law->add_force(state, scratch.applied);
    for (int axis = 0; axis < 3; ++axis) sink.applied[axis] = scratch.applied.col(axis).data();
  }
  sweep_.springs->sweep(state, sink, sweep_.friction, scratch);
}

double Forces::potential_energy(const State& state) const {
  double sum = 0.0;
  for (const auto& law : laws_) sum += law->energy(state);
  return sum;
}

bool Forces::passive() const {
  return std::all_of(laws_.begin(), laws_.end(), [](const auto& law) { return law->passive(); });
}

StiffnessMatrix Forces::linearise(const State& state, double position_weight, double velocity_weight,
                                  JacobianForm form) const {
  StiffnessMatrix matrix(structure_);
  linearise(state, position_weight, velocity_weight, form, matrix);
  return matrix;
}

void Forces::linearise(const State& state, double position_weight, double velocity_weight, JacobianForm form,
                       StiffnessMatrix& matrix) const {
  matrix.set_zero();
  for (const auto& law : laws_) law->add_linearisation(state, position_weight, velocity_weight, form, matrix);
}

StiffnessMatrix Forces::least_damping() const {
  StiffnessMatrix damping(structure_);
  for (const auto& law : laws_) law->add_least_damping(damping);
  return damping;
}

double Forces::work(const State& before, const State& after) const {
  double sum = 0.0;
  for (const auto& law : laws_) sum += law->work(before, after);
  return sum;
}

ForceBound Forces::bound(Shapes shapes) const {
  ForceBound bound{Linearisation(structure_), {}};
  for (const auto& law : laws_)
    if (!law->add_bound(shapes, bound.linearisation)) bound.unbounded.emplace_back(law->name());
  return bound;
}

}  // namespace billow::sim
