// Interpolation along a line of knots, written as weights.
#pragma once

#include <Eigen/Core>

namespace billow::sim {

/// The natural cubic spline through values at `knot` (k, ascending), as weights: its value at x is weight . values.
/// Twice continuously differentiable; straight beyond the ends; exact for straight lines, so weights sum to 1.
Eigen::VectorXd spline_weights(const Eigen::VectorXd& knot, double x);

}  // namespace billow::sim
