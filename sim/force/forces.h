// Everything that pushes a particle, and its linearisation.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "sim/body/state.h"
#include "sim/body/structure.h"
#include "sim/force/force_law.h"
#include "sim/linear/stiffness.h"
#include "sim/pass/pass_scratch.h"

namespace billow::sim {

struct SpringSink;

/// Memory that evaluations work in and use again. It belongs to the caller: two that run at the same time need two.
struct ForceScratch {
  PassScratch pass;
  Eigen::MatrixX3d applied;  // (n x 3) [N] what the laws outside the sweep come to
  Eigen::MatrixX3d springs;  // (p x 3) [N] of a body whose springs the vector passes do not know
};

/// What an evaluation makes of the force f on every particle.
struct Yield {
  enum class Kind { force, acceleration, velocity };
  Kind kind;
  double step = 0.0;  // [s]

  /// f [N]; of a pinned particle what the pin must hold.
  static Yield force() { return {Kind::force}; }
  /// M^-1 f [m/s^2]; zero for pinned particles.
  static Yield acceleration() { return {Kind::acceleration}; }
  /// v + step M^-1 f [m/s], v being the state's velocity.
  static Yield velocity(double step) { return {Kind::velocity, step}; }
};

/// What all laws together can be, and which of them have no bound.
struct ForceBound {
  Linearisation linearisation;
  std::vector<std::string> unbounded;
};

/// The sum of all laws that act in a scene.
class Forces {
 public:
  /// Nothing acts yet.
  explicit Forces(const Structure& structure) : structure_(structure) {}
  /// Springs and their damping, fluid friction, and gravity [m/s^2] (3) as `structure` and `gravity` say.
  Forces(const Structure& structure, const Eigen::Vector3d& gravity);

  void add(std::unique_ptr<ForceLaw> law);

  /// out (n x 3) = what `yield` says, at `state`.
  void evaluate(const State& state, const Yield& yield, Eigen::MatrixX3d& out, ForceScratch& scratch) const;

  /// Potential energy [J].
  double potential_energy(const State& state) const;
  /// Whether every law is passive: the energy of a run then never grows.
  bool passive() const;

  /// position_weight K + velocity_weight C at `state`.
  StiffnessMatrix linearise(const State& state, double position_weight, double velocity_weight,
                            JacobianForm form) const;
  /// The same into `matrix`, whose memory is used again.
  void linearise(const State& state, double position_weight, double velocity_weight, JacobianForm form,
                 StiffnessMatrix& matrix) const;
  /// What K and C never exceed at `shapes`, the laws without a bound left out and named.
  ForceBound bound(Shapes shapes) const;

  /// What C never falls short of at any shape.
  StiffnessMatrix least_damping() const;
  /// [J] what the laws that are not passive put in as `before` became `after`.
  double work(const State& before, const State& after) const;

  const Structure& structure() const { return structure_; }

 private:
  void sum_laws(const State& state, Eigen::MatrixX3d& force) const;
  void sweep(const State& state, const Yield& yield, Eigen::MatrixX3d& out, ForceScratch& scratch) const;

  const Structure& structure_;
  std::vector<std::unique_ptr<ForceLaw>> laws_;
  FusedSweep sweep_;                      // of the laws that joined it
  std::vector<const ForceLaw*> outside_;  // the others
};

}  // namespace billow::sim
