// Velocities -> colours.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "render/image/settings.h"

namespace billow::render {

using Rgb8 = std::array<std::uint8_t, 3>;

/// c = 1/2 + 1/2 v / v_max per axis, clamped, rounded to 8 bits: the paper's RGB velocity. v, v_max in m/s; v_max > 0.
Rgb8 velocity_rgb(const Eigen::Vector3d& velocity, double v_max);

/// A perceptually uniform map of t in [0, 1] (clamped), dark to light: sRGB-encoded.
Rgb8 magnitude_rgb(double t);

/// The colour at `t` in [0, 1] along a scale: of motion along that axis alone, from -v_max to v_max, or of speed.
Rgb8 colour_along(VelocityColour colour, int axis, double t);

}  // namespace billow::render
