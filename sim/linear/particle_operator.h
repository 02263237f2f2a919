// Linear operators on particle vectors, without their matrices.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace billow::sim {

/// y <- (operator) x on (n x 3) particle vectors; y has x's size.
using ParticleOperator = std::function<void(const Eigen::MatrixX3d& x, Eigen::MatrixX3d& y)>;

}  // namespace billow::sim
