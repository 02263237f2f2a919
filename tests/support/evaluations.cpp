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

sim::Linearisation bound_of(const sim::Structure& structure, sim::Shapes shapes) {
  return sim::Forces(structure, Eigen::Vector3d::Zero()).bound(shapes).linearisation;
}

Eigen::MatrixX3d minus_gradient(const std::function<double(const sim::State&)>& energy, sim::State state, double d) {
  Eigen::MatrixX3d gradient(state.position.rows(), 3);
  for (int c = 0; c < gradient.size(); ++c) {
    double& x = state.position.data()[c];
    const double here = x;
    x = here + d;
    const double above = energy(state);
    x = here - d;
    gradient.data()[c] = (energy(state) - above) / (2.0 * d);
    x = here;
  }
  return gradient;
}

Eigen::MatrixXd minus_slope(const std::function<Eigen::MatrixX3d(const sim::State&)>& force, sim::State state,
                            Eigen::MatrixX3d sim::State::*field, double d) {
  const int size = static_cast<int>(state.position.size());
  Eigen::MatrixXd slope(size, size);
  for (int column = 0; column < size; ++column) {
    double& entry = (state.*field)(column / 3, column % 3);
    const double here = entry;
    entry = here + d;
    const Eigen::MatrixX3d above = force(state);
    entry = here - d;
    slope.col(column) = (force(state) - above).transpose().reshaped() / (2.0 * d);
    entry = here;
  }
  return slope;
}

void apply(const sim::Filter& filter, const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field) {
  sim::FilterScratch scratch;
  filter.apply(position, time, field, scratch);
}

}  // namespace billow::test
