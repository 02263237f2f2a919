// Forces and filters evaluated once, with scratch memory of their own.
#pragma once

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

/// field <- F field, as Filter::apply.
void apply(const sim::Filter& filter, const Eigen::MatrixX3d& position, double time, Eigen::MatrixX3d& field);

}  // namespace billow::test
