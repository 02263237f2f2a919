// What a law of force has to say of itself. Everything is asked of every law, so that nothing can be forgotten.
#pragma once

#include <Eigen/Core>
#include <string_view>

#include "sim/body/state.h"
#include "sim/linear/stiffness.h"

namespace billow::sim {

/// The shapes over which a bound holds: the rest shape alone, or any that the structure can fold into.
enum class Shapes { rest, any };

class SpringForce;

/// What the one sweep over the springs takes besides them: laws whose force on a particle is that particle's own affair
/// cost nothing there. The order is the sweep's, whichever law joined first: springs, friction, gravity.
struct FusedSweep {
  const SpringForce* springs = nullptr;
  bool friction = false;                              // of each body, as the structure says
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  // [m/s^2]
};

/// One law of force over the whole structure. Stateless: everything it needs is in the structure or in itself.
class ForceLaw {
 public:
  virtual ~ForceLaw() = default;

  /// As messages call it: "the water's resistance".
  virtual std::string_view name() const = 0;

  /// force (n x 3) [N] += this law's force at `state`.
  virtual void add_force(const State& state, Eigen::MatrixX3d& force) const = 0;

  /// Potential energy [J] at `state`; 0 for laws that have none.
  virtual double energy(const State& state) const = 0;

  /// matrix += position_weight K + velocity_weight C with K = -df/dx and C = -df/dv at `state`.
  virtual void add_linearisation(const State& state, double position_weight, double velocity_weight, JacobianForm form,
                                 StiffnessMatrix& matrix) const = 0;

  /// bound += matrices that K and C, in their definite forms, never exceed at `shapes`, whatever the motion: x . K x is
  /// at most x . bound.stiffness x for every x, and likewise C. False, adding nothing, where the law has no such bound:
  /// a step limit then does not hold against it.
  virtual bool add_bound(Shapes shapes, Linearisation& bound) const = 0;

  /// damping += what C never falls short of, whatever the shape and the motion: nothing for a law that damps in some
  /// directions only. Forward Euler needs that much, where the other schemes bear no more than the bound.
  virtual void add_least_damping(StiffnessMatrix& damping) const = 0;

  /// Whether it only ever takes energy out of the motion, its own potential energy counted.
  virtual bool passive() const = 0;

  /// [J] the energy that it put in as `before` became `after`, a step later; 0 for passive laws, which need no account.
  virtual double work(const State& before, const State& after) const = 0;

  /// Whether `sweep`, as changed, now does all that add_force does.
  virtual bool join(FusedSweep& sweep) const = 0;
};

}  // namespace billow::sim
