// Forces and filters evaluated once, with scratch memory of their own, and their derivatives by differences.
#pragma once

#include <functional>

#include "sim/filter/filter.h"
#include "sim/force/forces.h"

namespace billow::test {

/// f [N] (n x 3) of all laws at `state`.
Eigen::MatrixX3d force_of(const sim::Forces& forces, const sim::State& state);
/// M^-1 f [m/s^2] (n x 3).
Eigen::MatrixX3d acceleration_of(const sim::Forces& forces, const sim::State& state);
/// v + h M^-1 f [m/s] (n x 3).
Eigen::MatrixX3d kicked(const sim::Forces& forces, const sim::State& state, double h);
/// f [N] (n x 3) of one law alone.
Eigen::MatrixX3d force_of(const sim::ForceLaw& law, const sim::State& state);

/// Springs and friction alone: what they never exceed at `shapes`.
sim::Linearisation bound_of(const sim::Structure& structure, sim::Shapes shapes);

/// Minus the gradient (n x 3) of `energy` by the position, from central differences over 2 d [m].
Eigen::MatrixX3d minus_gradient(const std::function<double(const sim::State&)>& energy, sim::State state, double d);
/// Minus the derivative (3n x 3n) of `force` by the position or the velocity, likewise: column 3 i + axis is the change
/// of all forces, row 3 j + axis, with that one entry.
Eigen::MatrixXd minus_slope(const std::function<Eigen::MatrixX3d(const sim::State&)>& force, sim::State state,
                            Eigen::MatrixX3d sim::State::*field, double d);

/// field <- F field, as Filter::apply.
void apply(const sim::Filter& filter, const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field);

}  // namespace billow::test
