// Contraction -> force.
#include "sim/muscle_force.h"

namespace billow::sim {
namespace {

Eigen::RowVector3d along(const Structure& structure, const State& state, int spring) {
  return state.position.row(structure.spring(spring, 1)) - state.position.row(structure.spring(spring, 0));
}

}  // namespace

MuscleForce::MuscleForce(const Structure& structure, int body, FishMotion motion)
    : structure_(structure), motion_(std::move(motion)), muscle_(fish_muscles()) {
  for (Muscle& muscle : muscle_) muscle.spring += structure.body[static_cast<std::size_t>(body)].first_spring;
}

void MuscleForce::add_force(const State& state, Eigen::MatrixX3d& force) const {
  for (const Muscle& muscle : muscle_) {
    const int s = muscle.spring;
    const Eigen::RowVector3d d = along(structure_, state, s);
    const double length = d.norm();
    if (length == 0.0) continue;
    const double shortening = structure_.rest_length(s) * motion_.contraction(muscle.segment, muscle.side, state.time);
    const Eigen::RowVector3d pull = structure_.stiffness(s) * shortening / length * d;
    force.row(structure_.spring(s, 0)) += pull;
    force.row(structure_.spring(s, 1)) -= pull;
  }
}

double MuscleForce::energy(const State& state) const {
  double sum = 0.0;
  for (const Muscle& muscle : muscle_) {
    const int s = muscle.spring;
    const double stretch = along(structure_, state, s).norm() - structure_.rest_length(s);
    const double shortening = structure_.rest_length(s) * motion_.contraction(muscle.segment, muscle.side, state.time);
    sum += structure_.stiffness(s) * shortening * (stretch + 0.5 * shortening);
  }
  return sum;
}

// -df/dx of T u with T the same at every length is T/l (I - u u^T).
void MuscleForce::add_linearisation(const State& state, double position_weight, double, JacobianForm form,
                                    StiffnessMatrix& matrix) const {
  if (form == JacobianForm::definite) return;
  for (const Muscle& muscle : muscle_) {
    const int s = muscle.spring;
    const Eigen::RowVector3d d = along(structure_, state, s);
    const double length = d.norm();
    if (length == 0.0) continue;
    const double tension = structure_.stiffness(s) * structure_.rest_length(s) *
                           motion_.contraction(muscle.segment, muscle.side, state.time);
    const double transverse = position_weight * tension / length;
    matrix.add_block(s, d.transpose() / length, transverse, -transverse);
  }
}

}  // namespace billow::sim
