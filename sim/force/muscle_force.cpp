// Contraction -> force.
#include "sim/force/muscle_force.h"

#include <algorithm>

namespace billow::sim {
namespace {

Eigen::RowVector3d along(const Structure& structure, const Eigen::MatrixX3d& position, int spring) {
  return position.row(structure.spring(spring, 1)) - position.row(structure.spring(spring, 0));
}

}  // namespace

MuscleForce::MuscleForce(const Structure& structure, int body, FishMotion motion)
    : structure_(structure), motion_(std::move(motion)), muscle_(fish_muscles()) {
  for (Muscle& muscle : muscle_) muscle.spring += structure.body[static_cast<std::size_t>(body)].first_spring;
}

double MuscleForce::tension(const Muscle& muscle, double time) const {
  const double shortening =
      structure_.rest_length(muscle.spring) * motion_.contraction(muscle.segment, muscle.side, time);
  return structure_.stiffness(muscle.spring) * shortening;
}

void MuscleForce::add_force(const State& state, Eigen::MatrixX3d& force) const {
  for (const Muscle& muscle : muscle_) {
    const int s = muscle.spring;
    const Eigen::RowVector3d d = along(structure_, state.position, s);
    const double length = d.norm();
    if (length == 0.0) continue;
    const Eigen::RowVector3d pull = tension(muscle, state.time) / length * d;
    force.row(structure_.spring(s, 0)) += pull;
    force.row(structure_.spring(s, 1)) -= pull;
  }
}

double MuscleForce::energy(const State& state) const { return energy(state.position, state.time); }

double MuscleForce::work(const State& before, const State& after) const {
  return 0.5 * (energy(before.position, after.time) - energy(before.position, before.time) +
                energy(after.position, after.time) - energy(after.position, before.time));
}

double MuscleForce::energy(const Eigen::MatrixX3d& position, double time) const {
  double sum = 0.0;
  for (const Muscle& muscle : muscle_) {
    const int s = muscle.spring;
    const double stretch = along(structure_, position, s).norm() - structure_.rest_length(s);
    const double shortening = structure_.rest_length(s) * motion_.contraction(muscle.segment, muscle.side, time);
    sum += structure_.stiffness(s) * shortening * (stretch + 0.5 * shortening);
  }
  return sum;
}

// -df/dx of T u with T the same at every length is T/l (I - u u^T).
void MuscleForce::add_linearisation(const State& state, double position_weight, double, JacobianForm form,
                                    StiffnessMatrix& matrix) const {
  if (form == JacobianForm::definite) return;
  for (const Muscle& muscle : muscle_) {
    const Eigen::RowVector3d d = along(structure_, state.position, muscle.spring);
    const double length = d.norm();
    if (length == 0.0) continue;
    const double transverse = position_weight * tension(muscle, state.time) / length;
    matrix.add_spring(muscle.spring, d.transpose() / length, transverse, -transverse);
  }
}

bool MuscleForce::add_bound(Shapes shapes, Linearisation& bound) const {
  if (shapes == Shapes::any) return true;
  for (const Muscle& muscle : muscle_) {
    const Eigen::RowVector3d d = along(structure_, structure_.rest_position, muscle.spring);
    const double transverse =
        structure_.stiffness(muscle.spring) * motion_.largest_contraction(muscle.segment, muscle.side);
    bound.stiffness.add_spring(muscle.spring, d.transpose().normalized(), transverse, -transverse);
  }
  return true;
}

bool MuscleForce::passive() const {
  return std::all_of(muscle_.begin(), muscle_.end(), [this](const Muscle& muscle) {
    return motion_.largest_contraction(muscle.segment, muscle.side) == 0.0;
  });
}

}  // namespace billow::sim
