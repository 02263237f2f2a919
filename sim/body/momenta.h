// What a moving structure carries.
#pragma once

#include <Eigen/Core>

#include "sim/body/state.h"
#include "sim/body/structure.h"

namespace billow::sim {

/// Kinetic energy [J], linear momentum [kg m/s] and angular momentum about the origin [kg m^2/s].
double kinetic_energy(const Structure& structure, const State& state);
Eigen::Vector3d linear_momentum(const Structure& structure, const State& state);
Eigen::Vector3d angular_momentum(const Structure& structure, const State& state);

}  // namespace billow::sim
