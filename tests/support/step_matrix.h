// A linear step written out as a matrix, one column per unknown: what searches for eigenvalues are checked against.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "sim/filtered_step.h"
#include "sim/forces.h"
#include "sim/stiffness.h"

namespace billow::test {

/// f = -K x - C v, where the state's positions are displacements.
class LinearForce : public sim::ForceTerm {
 public:
  explicit LinearForce(const sim::Linearisation& linearisation) : linearisation_(linearisation) {}
  void add_force(const sim::State& state, Eigen::MatrixX3d& force) const override;
  void add_linearisation(const sim::State&, double position_weight, double velocity_weight, sim::JacobianForm,
                         sim::StiffnessMatrix& matrix) const override;

 private:
  const sim::Linearisation& linearisation_;
};

/// The forces of one linearisation. `structure` and `linearisation` must outlive them.
sim::Forces linear_forces(const sim::Structure& structure, const sim::Linearisation& linearisation);

/// A step on displacements and velocities.
using LinearStep = std::function<void(sim::State& state, double h)>;

/// Column c is what the step makes of unknown c: the free particles' displacements, then their velocities times
/// `time_scale` [s], so that both are lengths (6 n_free x 6 n_free).
Eigen::MatrixXd step_matrix(const sim::Structure& structure, const LinearStep& step, double h, double time_scale);

/// Largest modulus of the eigenvalues.
double spectral_radius(const Eigen::MatrixXd& matrix);

/// M^-1 K of the free particles (3 n_free x 3 n_free), from K applied to every unit displacement.
Eigen::MatrixXd dense_dynamics(const sim::Structure& structure, const sim::StiffnessMatrix& stiffness);

}  // namespace billow::test
