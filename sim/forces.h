// Everything that pushes a particle, and its linearisation.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "sim/state.h"
#include "sim/stiffness.h"
#include "sim/structure.h"

namespace billow::sim {

/// One law of force over the whole structure. Stateless: everything it needs is in the structure or in itself.
class ForceTerm {
 public:
  virtual ~ForceTerm() = default;
  /// force (n x 3) [N] += this law's force at `state`.
  virtual void add_force(const State& state, Eigen::MatrixX3d& force) const = 0;
  /// Potential energy [J]; 0 for laws that have none.
  virtual double energy(const State&) const { return 0.0; }
  /// matrix += position_weight K + velocity_weight C with K = -df/dx and C = -df/dv at `state`.
  virtual void add_linearisation(const State&, double /*position_weight*/, double /*velocity_weight*/, JacobianForm,
                                 StiffnessMatrix&) const {}
};

class SpringForce;
struct SpringSink;

/// The sum of all laws that act in a scene.
class Forces {
 public:
  /// Springs and their damping, fluid friction, and gravity [m/s^2] (3) as `structure` and `gravity` say.
  Forces(const Structure& structure, const Eigen::Vector3d& gravity);
  /// Only the given terms: what tests and the certificate use.
  Forces(const Structure& structure, std::vector<std::unique_ptr<ForceTerm>> terms);
  virtual ~Forces() = default;

  void add(std::unique_ptr<ForceTerm> term) { terms_.push_back(std::move(term)); }

  /// force (n x 3) [N] at `state`; rows of pinned particles are what the pin must hold.
  virtual void evaluate(const State& state, Eigen::MatrixX3d& force) const;
  /// acceleration (n x 3) [m/s^2] = M^-1 f; zero for pinned particles.
  virtual void acceleration(const State& state, Eigen::MatrixX3d& acceleration) const;
  /// velocity (n x 3) [m/s] = state.velocity + h M^-1 f.
  virtual void kick(const State& state, double h, Eigen::MatrixX3d& velocity) const;
  /// Potential energy [J].
  double potential_energy(const State& state) const;
  /// position_weight K + velocity_weight C at `state`.
  StiffnessMatrix linearise(const State& state, double position_weight, double velocity_weight,
                            JacobianForm form) const;
  /// The same into `matrix`, whose memory is used again.
  void linearise(const State& state, double position_weight, double velocity_weight, JacobianForm form,
                 StiffnessMatrix& matrix) const;

  const Structure& structure() const { return structure_; }

 private:
  void sweep(const State& state, SpringSink& sink) const;

  const Structure& structure_;
  std::vector<std::unique_ptr<ForceTerm>> terms_;
  // The springs among the terms, when the next two are friction and this gravity: one sweep then takes all three.
  const SpringForce* springs_ = nullptr;
  Eigen::Vector3d gravity_ = Eigen::Vector3d::Zero();
};

/// Kinetic energy [J], linear momentum [kg m/s] and angular momentum about the origin [kg m^2/s].
double kinetic_energy(const Structure& structure, const State& state);
Eigen::Vector3d linear_momentum(const Structure& structure, const State& state);
Eigen::Vector3d angular_momentum(const Structure& structure, const State& state);

}  // namespace billow::sim
