// The sum of the laws of force, and the simple ones: gravity and fluid friction.
#include "sim/forces.h"

#include <Eigen/Geometry>

#include "sim/huge_pages.h"
#include "sim/spring_force.h"

namespace billow::sim {

namespace {

constexpr std::size_t swept_terms = 3;  // springs, friction, gravity

void make_room(const Structure& structure, Eigen::MatrixX3d& field) {
  if (field.rows() == structure.particles()) return;
  field.resize(structure.particles(), 3);
  use_huge_pages(field);
}

/// f = m g, energy -m g . x.
class Gravity : public ForceTerm {
 public:
  Gravity(const Structure& structure, const Eigen::Vector3d& gravity) : structure_(structure), gravity_(gravity) {}
  void add_force(const State&, Eigen::MatrixX3d& force) const override {
    for (int axis = 0; axis < 3; ++axis)
      if (gravity_(axis) != 0.0) force.col(axis) += gravity_(axis) * structure_.mass;
  }
  double energy(const State& state) const override { return -structure_.mass.dot(state.position * gravity_); }

 private:
  const Structure& structure_;
  Eigen::Vector3d gravity_;
};

/// f = -c v per particle, c by body.
class FluidFriction : public ForceTerm {
 public:
  explicit FluidFriction(const Structure& structure) : structure_(structure) {}
  void add_force(const State& state, Eigen::MatrixX3d& force) const override {
    for (const Body& body : structure_.body) {
      if (body.friction == 0.0) continue;
      force.middleRows(body.first_particle, body.particles) -=
          body.friction * state.velocity.middleRows(body.first_particle, body.particles);
    }
  }
  void add_linearisation(const State&, double, double velocity_weight, JacobianForm,
                         StiffnessMatrix& matrix) const override {
    for (const Body& body : structure_.body)
      for (int i = body.first_particle; i < body.first_particle + body.particles; ++i)
        matrix.add_diagonal(i, velocity_weight * body.friction);
  }

 private:
  const Structure& structure_;
};

}  // namespace

Forces::Forces(const Structure& structure, const Eigen::Vector3d& gravity) : structure_(structure), gravity_(gravity) {
  auto springs = std::make_unique<SpringForce>(structure);
  springs_ = springs.get();
  add(std::move(springs));
  add(std::make_unique<FluidFriction>(structure));
  add(std::make_unique<Gravity>(structure, gravity));
  use_huge_pages(structure.mass), use_huge_pages(structure.inverse_mass);
}

Forces::Forces(const Structure& structure, std::vector<std::unique_ptr<ForceTerm>> terms)
    : structure_(structure), terms_(std::move(terms)) {}

void Forces::evaluate(const State& state, Eigen::MatrixX3d& force) const {
  force.setZero(structure_.particles(), 3);
  for (const auto& term : terms_) term->add_force(state, force);
}

void Forces::acceleration(const State& state, Eigen::MatrixX3d& acceleration) const {
  if (springs_) {
    make_room(structure_, acceleration);
    SpringSink sink;
    for (int axis = 0; axis < 3; ++axis) sink.out[axis] = acceleration.col(axis).data();
    return sweep(state, sink);
  }
  evaluate(state, acceleration);
  for (int axis = 0; axis < 3; ++axis) acceleration.col(axis).array() *= structure_.inverse_mass.array();
}

void Forces::kick(const State& state, double h, Eigen::MatrixX3d& velocity) const {
  if (!springs_) {
    acceleration(state, velocity);
    velocity = state.velocity + h * velocity;
    return;
  }
  make_room(structure_, velocity);
  SpringSink sink;
  sink.step = h;
  for (int axis = 0; axis < 3; ++axis) {
    sink.base[axis] = state.velocity.col(axis).data();
    sink.out[axis] = velocity.col(axis).data();
  }
  sweep(state, sink);
}

// Springs, friction, gravity and masses in one pass over memory; what else acts is summed before it.
void Forces::sweep(const State& state, SpringSink& sink) const {
  Eigen::MatrixX3d applied;
  if (terms_.size() > swept_terms) applied = Eigen::MatrixX3d::Zero(structure_.particles(), 3);
  for (std::size_t k = swept_terms; k < terms_.size(); ++k) terms_[k]->add_force(state, applied);
  sink.mass = structure_.mass.data();
  sink.inverse_mass = structure_.inverse_mass.data();
  for (int axis = 0; axis < 3; ++axis) {
    sink.velocity[axis] = state.velocity.col(axis).data();
    sink.gravity[axis] = gravity_(axis);
    if (applied.size() > 0) sink.applied[axis] = applied.col(axis).data();
  }
  springs_->sweep(state, sink);
}

double Forces::potential_energy(const State& state) const {
  double sum = 0.0;
  for (const auto& term : terms_) sum += term->energy(state);
  return sum;
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
  for (const auto& term : terms_) term->add_linearisation(state, position_weight, velocity_weight, form, matrix);
}

double kinetic_energy(const Structure& structure, const State& state) {
  double sum = 0.0;
  for (int i = 0; i < structure.particles(); ++i) sum += 0.5 * structure.mass(i) * state.velocity.row(i).squaredNorm();
  return sum;
}

Eigen::Vector3d linear_momentum(const Structure& structure, const State& state) {
  return state.velocity.transpose() * structure.mass;
}

Eigen::Vector3d angular_momentum(const Structure& structure, const State& state) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < structure.particles(); ++i) {
    const Eigen::Vector3d x = state.position.row(i), v = state.velocity.row(i);
    sum += structure.mass(i) * x.cross(v);
  }
  return sum;
}

}  // namespace billow::sim
