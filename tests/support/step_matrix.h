// A linear step written out as a matrix, one column per unknown: what searches for eigenvalues are checked against.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "sim/limit/linear_force.h"
#include "sim/step/step.h"

namespace billow::test {

/// A step on displacements and velocities.
using LinearStep = std::function<void(sim::State& state, double h)>;

/// Column c is what the step makes of unknown c: the free particles' displacements, then their velocities times
/// `time_scale` [s], so that both are lengths (6 n_free x 6 n_free).
Eigen::MatrixXd step_matrix(const sim::Structure& structure, const LinearStep& step, double h, double time_scale);

/// Largest modulus of the eigenvalues.
double spectral_radius(const Eigen::MatrixXd& matrix);

/// Of a symmetric matrix.
double least_eigenvalue(const Eigen::MatrixXd& matrix);

/// M^-1 K of the free particles (3 n_free x 3 n_free), from K applied to every unit displacement.
Eigen::MatrixXd dense_dynamics(const sim::Structure& structure, const sim::StiffnessMatrix& stiffness);

}  // namespace billow::test
