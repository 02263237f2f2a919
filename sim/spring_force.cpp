// The spring pass.
#include "sim/spring_force.h"

#include <algorithm>
#include <cmath>

#include "sim/spring_law.h"

namespace billow::sim {

namespace {

/// Raw columns of the arrays that a spring pass reads and writes.
struct SpringPass {
  const int *first, *second;
  const double *rest_length, *stiffness, *damping;
  const double *x, *y, *z, *vx, *vy, *vz;
  double *fx, *fy, *fz;

  SpringPass(const Structure& s, const State& state, Eigen::MatrixX3d& force)
      : first(s.spring.col(0).data()),
        second(s.spring.col(1).data()),
        rest_length(s.rest_length.data()),
        stiffness(s.stiffness.data()),
        damping(s.damping.data()),
        x(state.position.col(0).data()),
        y(state.position.col(1).data()),
        z(state.position.col(2).data()),
        vx(state.velocity.col(0).data()),
        vy(state.velocity.col(1).data()),
        vz(state.velocity.col(2).data()),
        fx(force.col(0).data()),
        fy(force.col(1).data()),
        fz(force.col(2).data()) {}

  void push(int i, int j, double x_part, double y_part, double z_part) const {
    fx[i] += x_part, fy[i] += y_part, fz[i] += z_part;
    fx[j] -= x_part, fy[j] -= y_part, fz[j] -= z_part;
  }
};

// Elastic part: `law(spring, length)` is the tension. A spring of zero length has no direction and pushes nowhere.
template <class Law>
void add_elastic(const SpringPass& p, int begin, int end, const Law& law) {
  for (int s = begin; s < end; ++s) {
    const int i = p.first[s], j = p.second[s];
    const double dx = p.x[j] - p.x[i], dy = p.y[j] - p.y[i], dz = p.z[j] - p.z[i];
    const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
    const double scale = length > 0.0 ? law(s, length) / length : 0.0;
    p.push(i, j, scale * dx, scale * dy, scale * dz);
  }
}

void add_elastic(const SpringPass& p, const Structure& structure, const Body& body) {
  const int begin = body.first_spring, end = begin + body.springs;
  if (body.spring_model == SpringModel::linear)
    add_elastic(p, begin, end, [&](int s, double l) { return p.stiffness[s] * (l - p.rest_length[s]); });
  else
    add_elastic(p, begin, end, [&](int s, double l) {
      return tension(body, structure.kind[s], l, p.rest_length[s], p.stiffness[s]).force;
    });
}

// c (u . w) u along the spring, w the relative velocity: rigid rotation has u . w = 0 and is not damped.
void add_projected_damping(const SpringPass& p, int begin, int end) {
  for (int s = begin; s < end; ++s) {
    const int i = p.first[s], j = p.second[s];
    const double dx = p.x[j] - p.x[i], dy = p.y[j] - p.y[i], dz = p.z[j] - p.z[i];
    const double wx = p.vx[j] - p.vx[i], wy = p.vy[j] - p.vy[i], wz = p.vz[j] - p.vz[i];
    const double square = dx * dx + dy * dy + dz * dz;
    const double scale = square > 0.0 ? p.damping[s] * (dx * wx + dy * wy + dz * wz) / square : 0.0;
    p.push(i, j, scale * dx, scale * dy, scale * dz);
  }
}

// c w: also damps rigid rotation, the common incorrect model.
void add_relative_damping(const SpringPass& p, int begin, int end) {
  for (int s = begin; s < end; ++s) {
    const int i = p.first[s], j = p.second[s];
    const double c = p.damping[s];
    p.push(i, j, c * (p.vx[j] - p.vx[i]), c * (p.vy[j] - p.vy[i]), c * (p.vz[j] - p.vz[i]));
  }
}

bool is_damped(const Structure& structure, const Body& body) {
  return (structure.damping.segment(body.first_spring, body.springs).array() > 0.0).any();
}

}  // namespace

void SpringForce::add_force(const State& state, Eigen::MatrixX3d& force) const {
  const SpringPass pass(structure_, state, force);
  for (const Body& body : structure_.body) {
    add_elastic(pass, structure_, body);
    if (!is_damped(structure_, body)) continue;
    const auto add_damping =
        body.damping_model == DampingModel::projected ? add_projected_damping : add_relative_damping;
    add_damping(pass, body.first_spring, body.first_spring + body.springs);
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
  for (const Body& body : structure_.body)
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

}  // namespace billow::sim
