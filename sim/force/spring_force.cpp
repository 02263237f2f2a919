// Springs one by one, in vector sweeps, and linearised.
#include "sim/force/spring_force.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "sim/body/spring_law.h"
#include "sim/force/fluid_friction.h"
#include "sim/force/forces.h"
#include "sim/pass/spring_pass.h"

namespace billow::sim {

namespace {

SpringColumns columns_of(const State& state) {
  SpringColumns columns{};
  for (int axis = 0; axis < 3; ++axis) {
    columns.position[axis] = state.position.col(axis).data();
    columns.velocity[axis] = state.velocity.col(axis).data();
  }
  return columns;
}

// force (rows from `first_particle` on) += one spring after another.
void add_springs(const Structure& structure, const Body& body, const State& state, int first_particle,
                 Eigen::MatrixX3d& force) {
  for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
    const int i = structure.spring(s, 0), j = structure.spring(s, 1);
    const Eigen::RowVector3d d = state.position.row(j) - state.position.row(i);
    const double length = d.norm();
    if (length == 0.0 && body.damping_model == DampingModel::projected) continue;
    Eigen::RowVector3d pull = Eigen::RowVector3d::Zero();
    if (length > 0.0)
      pull =
          tension(body, structure.kind[s], length, structure.rest_length(s), structure.stiffness(s)).force / length * d;
    if (structure.damping(s) > 0.0) {
      const Eigen::RowVector3d w = state.velocity.row(j) - state.velocity.row(i);
      const double c = structure.damping(s);
      pull +=
          body.damping_model == DampingModel::projected ? (c * d.dot(w) / d.squaredNorm() * d).eval() : (c * w).eval();
    }
    force.row(i - first_particle) += pull;
    force.row(j - first_particle) -= pull;
  }
}

void sweep_bands(const SpringBands& bands, const SpringColumns& columns, const SpringSink& sink, PassScratch& scratch) {
  // A part repeats the springs that reach into it from before: it should be long compared with the longest stride.
  const int least_part = std::max(least_part_of_a_pass, 8 * bands.stride.back());
  for_each_range(bands.particles, band_group, least_part, [&](int part, int begin, int end) {
    sweep_springs(bands, columns, sink, begin, end, scratch.part(part));
  });
}

// Slices take particles in an order of their own: their sums wait in `out`, and what else a sink does comes after all.
void sweep_slices(const SpringSlices& slices, const SpringColumns& columns, const SpringSink& sink,
                  PassScratch& scratch) {
  const SpringSink own = sink.from(slices.first_particle);
  // A part repeats the springs of two reaches.
  const int least_part = std::max(least_part_of_a_pass / slice_lanes, 8 * slices.reach);
  for_each_range(
      slices.slices, 1, least_part,
      [&](int part, int begin, int end) { sum_springs(slices, columns, own.out, begin, end, scratch.part(part)); },
      slice_lanes);
  if (!sink.mass) return;
  for_each_range(slices.particles, 1, least_part_of_a_pass,
                 [&](int, int begin, int end) { put_sums(own, own.out, begin, end); });
}

}  // namespace

void SpringForce::add_force(const State& state, Eigen::MatrixX3d& force) const {
  for (const Body& body : structure_.body) add_springs(structure_, body, state, 0, force);
}

bool SpringForce::join(FusedSweep& sweep) const {
  if (sweep.springs) return false;
  sweep.springs = this;
  return true;
}

void SpringForce::sweep(const State& state, const SpringSink& sink, bool friction, ForceScratch& scratch) const {
  const SpringColumns columns = columns_of(state);
  const auto sink_of = [&](const Body& body) {
    SpringSink own = sink;
    own.friction = friction ? body.friction : 0.0;
    return own;
  };
  scratch.pass.prepare();
  const SpringPlan& plan = laid_out();
  for (const SpringBands& bands : plan.bands)
    sweep_bands(bands, columns, sink_of(structure_.body[bands.body]), scratch.pass);
  for (const SpringSlices& slices : plan.slices)
    sweep_slices(slices, columns, sink_of(structure_.body[slices.body]), scratch.pass);
  for (const int b : plan.others) {
    const Body& body = structure_.body[b];
    Eigen::MatrixX3d& sum = scratch.springs;
    sum.setZero(body.particles, 3);
    add_springs(structure_, body, state, body.first_particle, sum);
    const double* const columns_of_sum[3] = {sum.col(0).data(), sum.col(1).data(), sum.col(2).data()};
    put_sums(sink_of(body).from(body.first_particle), columns_of_sum, 0, body.particles);
  }
}

const SpringPlan& SpringForce::laid_out() const {
  std::call_once(once_, [this] { plan_.emplace(structure_); });
  return *plan_;
}

double SpringForce::energy(const State& state) const {
  double sum = 0.0;
  for (const Body& body : structure_.body)
    for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
      const double length =
          (state.position.row(structure_.spring(s, 1)) - state.position.row(structure_.spring(s, 0))).norm();
      sum += spring_energy(body, structure_.kind[s], length, structure_.rest_length(s), structure_.stiffness(s));
    }
  return sum;
}

namespace {

// How projected damping c (d . w) / d^2 d turns with the spring: its derivative by d, w the relative velocity.
Eigen::Matrix3d damping_turned(const Eigen::Vector3d& d, const Eigen::Vector3d& w, double damping) {
  const double square = d.squaredNorm(), along = d.dot(w);
  const Eigen::Matrix3d outer = d * w.transpose() + along * Eigen::Matrix3d::Identity();
  return damping / square * (outer - 2.0 * along / square * d * d.transpose());
}

}  // namespace

// -df/dx of T(l) u is T/l (I - u u^T) + T' u u^T; -df/dv is c u u^T (projected) or c I.
void SpringForce::add_linearisation(const State& state, double position_weight, double velocity_weight,
                                    JacobianForm form, StiffnessMatrix& matrix) const {
  const bool definite = form == JacobianForm::definite;
  for (const Body& body : structure_.body) {
    if (position_weight == 0.0 && !is_damped(structure_, body)) continue;
    const bool projected = body.damping_model == DampingModel::projected;
    for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
      const int i = structure_.spring(s, 0), j = structure_.spring(s, 1);
      const Eigen::RowVector3d d = state.position.row(j) - state.position.row(i);
      const double length = d.norm();
      if (length == 0.0) continue;
      const Tension t = tension(body, structure_.kind[s], length, structure_.rest_length(s), structure_.stiffness(s));
      const double transverse = definite ? std::max(t.force, 0.0) / length : t.force / length;
      const double slope = definite ? std::max(t.slope, 0.0) : t.slope;
      const double c = velocity_weight * structure_.damping(s);
      matrix.add_spring(s, d.transpose() / length, position_weight * transverse + (projected ? 0.0 : c),
                        position_weight * (slope - transverse) + (projected ? c : 0.0));
      if (definite || !projected || structure_.damping(s) == 0.0 || position_weight == 0.0) continue;
      const Eigen::RowVector3d w = state.velocity.row(j) - state.velocity.row(i);
      matrix.add_pair(i, j, position_weight * damping_turned(d, w, structure_.damping(s)));
    }
  }
}

namespace {

void add_spring_bound(const Structure& structure, Shapes shapes, Linearisation& bound) {
  const bool any = shapes == Shapes::any;
  const auto add = [](StiffnessMatrix& matrix, int s, const Eigen::Vector3d& u, double value, bool isotropic) {
    matrix.add_spring(s, u, isotropic ? value : 0.0, isotropic ? 0.0 : value);
  };
  for (const Body& body : structure.body)
    for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
      const Eigen::RowVector3d d =
          structure.rest_position.row(structure.spring(s, 1)) - structure.rest_position.row(structure.spring(s, 0));
      const Eigen::Vector3d u = d.normalized();
      const double k = structure.stiffness(s);
      add(bound.stiffness, s, u, any ? steepest_slope(body, structure.kind[s], structure.rest_length(s), k) : k, any);
      add(bound.damping, s, u, structure.damping(s), any || body.damping_model == DampingModel::spring);
    }
}

}  // namespace

bool SpringForce::add_bound(Shapes shapes, Linearisation& bound) const {
  add_spring_bound(structure_, shapes, bound);
  return true;
}

// Projected damping lets what moves across a spring pass.
void SpringForce::add_least_damping(StiffnessMatrix& damping) const {
  for (const Body& body : structure_.body) {
    if (body.damping_model != DampingModel::spring) continue;
    for (int s = body.first_spring; s < body.first_spring + body.springs; ++s)
      damping.add_spring(s, Eigen::Vector3d::UnitX(), structure_.damping(s), 0.0);
  }
}

Linearisation linearise_at_rest(const Structure& structure) {
  Linearisation bound(structure);
  add_spring_bound(structure, Shapes::rest, bound);
  add_friction(structure, 1.0, bound.damping);
  return bound;
}

}  // namespace billow::sim
