#include "tests/support/evaluations.h"

namespace billow::test {

namespace {

Eigen::MatrixX3d evaluated(const sim::Forces& forces, const sim::State& state, const sim::Yield& yield) {
  sim::ForceScratch scratch;
  Eigen::MatrixX3d out;
  forces.evaluate(state, yield, out, scratch);
  return out;
}

}  // namespace

Eigen::MatrixX3d force_of(const sim::Forces& forces, const sim::State& state) {
  return evaluated(forces, state, sim::Yield::force());
}

Eigen::MatrixX3d acceleration_of(const sim::Forces& forces, const sim::State& state) {
  return evaluated(forces, state, sim::Yield::acceleration());
}

Eigen::MatrixX3d kicked(const sim::Forces& forces, const sim::State& state, double h) {
  return evaluated(forces, state, sim::Yield::velocity(h));
}

Eigen::MatrixX3d force_of(const sim::ForceLaw& law, const sim::State& state) {
  Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(state.position.rows(), 3);
  law.add_force(state, force);
  return force;
}

void apply(const sim::Filter& filter, const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field) {
  sim::FilterScratch scratch;
  filter.apply(position, time, field, scratch);
}

}  // namespace billow::test
