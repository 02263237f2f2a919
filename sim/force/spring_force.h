// Springs and their damping as one law of force.
#pragma once

#include <mutex>
#include <optional>

#include "sim/force/force_law.h"
#include "sim/pass/spring_plan.h"
#include "sim/pass/spring_sink.h"

namespace billow::sim {

struct ForceScratch;

/// f_i = T(|d|) d/|d| + damping, d = x_j - x_i, for every spring of the structure, by each body's model.
/// The springs are laid out for the vector passes when they are first swept: the structure must not change once this is
/// made.
class SpringForce : public ForceLaw {
 public:
  explicit SpringForce(const Structure& structure) : structure_(structure) {}
  std::string_view name() const override { return "the springs"; }
  /// One spring after another: what every sweep must come to.
  void add_force(const State& state, Eigen::MatrixX3d& force) const override;
  double energy(const State& state) const override;
  void add_linearisation(const State& state, double position_weight, double velocity_weight, JacobianForm form,
                         StiffnessMatrix& matrix) const override;
  /// At rest every spring with its full stiffness along itself, whichever way its model would let it go slack. At any
  /// shape with its steepest slope in all directions at once: while tensions stay below k l, a spring's true block
  /// (T/l) I + (k - T/l) u u^T is at most k I whatever its direction, so no fold or crumple is stiffer than this.
  bool add_bound(Shapes shapes, Linearisation& bound) const override;
  void add_least_damping(StiffnessMatrix& damping) const override;
  bool passive() const override { return true; }
  double work(const State&, const State&) const override { return 0.0; }
  bool join(FusedSweep& sweep) const override;

  /// Puts the sum of its springs, also where there are none, of every particle into `sink`, with each body's friction
  /// where `friction`.
  void sweep(const State& state, const SpringSink& sink, bool friction, ForceScratch& scratch) const;

 private:
  const SpringPlan& laid_out() const;

  const Structure& structure_;
  // Made by the first sweep, whichever thread it comes from: who only asks for bounds does without.
  mutable std::once_flag once_;
  mutable std::optional<SpringPlan> plan_;
};

/// Springs, their damping and friction at rest: what Forces::bound comes to where nothing else acts, without laying the
/// springs out for the passes.
Linearisation linearise_at_rest(const Structure& structure);

}  // namespace billow::sim
