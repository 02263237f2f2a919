// The spring pass.
#include "sim/spring_force.h"

#include <algorithm>
#include <cmath>

#include "sim/parallel.h"
#include "sim/spring_law.h"
#include "sim/spring_pass.h"

namespace billow::sim {

namespace {

// Fewer particles than this are not worth a thread's while.
constexpr int least_part = 2048;

SpringColumns columns_of(const State& state) {
  SpringColumns columns{};
  for (int axis = 0; axis < 3; ++axis) {
    columns.position[axis] = state.position.col(axis).data();
    columns.velocity[axis] = state.velocity.col(axis).data();
  }
  return columns;
}

// One spring after another: the models whose tension is a function of its own. force (body.particles x 3)
void add_other(const Structure& structure, const Body& body, const State& state, Eigen::MatrixX3d& force) {
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
    force.row(i - body.first_particle) += pull;
    force.row(j - body.first_particle) -= pull;
  }
}

// Slices take particles in an order of their own: their sums wait in `out`, and what else a sink does comes after all.
void sweep_slices(const SpringSlices& slices, const SpringColumns& columns, const SpringSink& sink) {
  const SpringSink own = sink.from(slices.first_particle);
  // A part repeats the springs of two reaches.
  for_each_range(
      slices.slices, 1, std::max(least_part / slice_lanes, 8 * slices.reach),
      [&](int begin, int end) { sum_springs(slices, columns, own.out, begin, end); }, slice_lanes);
  if (!sink.mass) return;
  for_each_range(slices.particles, 1, least_part, [&](int begin, int end) { put_sums(own, own.out, begin, end); });
}

}  // namespace

void SpringForce::add_force(const State& state, Eigen::MatrixX3d& force) const {
  static thread_local Eigen::MatrixX3d springs;  // kept from call to call
  evaluate(state, springs);
  force += springs;
}

void SpringForce::evaluate(const State& state, Eigen::MatrixX3d& force) const {
  force.resize(structure_.particles(), 3);
  SpringSink sink;
  for (int axis = 0; axis < 3; ++axis) sink.out[axis] = force.col(axis).data();
  sweep(state, sink);
}

void SpringForce::sweep(const State& state, const SpringSink& sink) const {
  const SpringColumns columns = columns_of(state);
  const auto sink_of = [&](const Body& body) {
    SpringSink own = sink;
    own.friction = body.friction;
    return own;
  };
  for (const SpringBands& bands : plan_.bands) {
    const SpringSink own = sink_of(structure_.body[bands.body]);
    // A part repeats the springs that reach into it from before: it should be long compared with the longest stride.
    for_each_range(bands.particles, band_group, std::max(least_part, 8 * bands.stride.back()),
                   [&](int begin, int end) { sweep_springs(bands, columns, own, begin, end); });
  }
  for (const SpringSlices& slices : plan_.slices) sweep_slices(slices, columns, sink_of(structure_.body[slices.body]));
  for (const int b : plan_.others) {
    const Body& body = structure_.body[b];
    Eigen::MatrixX3d sum = Eigen::MatrixX3d::Zero(body.particles, 3);
    add_other(structure_, body, state, sum);
    const double* const columns_of_sum[3] = {sum.col(0).data(), sum.col(1).data(), sum.col(2).data()};
    put_sums(sink_of(body).from(body.first_particle), columns_of_sum, 0, body.particles);
  }
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

// -df/dx of T(l) u is T/l (I - u u^T) + T' u u^T; -df/dv is c u u^T (projected) or c I.
void SpringForce::add_linearisation(const State& state, double position_weight, double velocity_weight,
                                    JacobianForm form, StiffnessMatrix& matrix) const {
  for (const Body& body : structure_.body) {
    if (position_weight == 0.0 && !is_damped(structure_, body)) continue;
    for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
      const Eigen::RowVector3d d =
          state.position.row(structure_.spring(s, 1)) - state.position.row(structure_.spring(s, 0));
      const double length = d.norm();
      if (length == 0.0) continue;
      const Tension t = tension(body, structure_.kind[s], length, structure_.rest_length(s), structure_.stiffness(s));
      const bool definite = form == JacobianForm::definite;
      const double transverse = definite ? std::max(t.force, 0.0) / length : t.force / length;
      const double slope = definite ? std::max(t.slope, 0.0) : t.slope;
      const double c = velocity_weight * structure_.damping(s);
      const bool projected = body.damping_model == DampingModel::projected;
      matrix.add_block(s, d.transpose() / length, position_weight * transverse + (projected ? 0.0 : c),
                       position_weight * (slope - transverse) + (projected ? c : 0.0));
    }
  }
}

}  // namespace billow::sim
