// The two velocity colourings of the paper's pictures.
#include "render/image/colour_map.h"

#include <algorithm>
#include <cmath>

namespace billow::render {
namespace {

// "viridis" by Nathaniel Smith, Stefan van der Walt and Eric Firing (CC0, github.com/BIDS/colormap): every 17th of its
// 256 colours. Straight lines between them stay within 4/255 of the original.
constexpr std::array<Rgb8, 16> viridis{{{68, 1, 84},
                                        {72, 26, 108},
                                        {71, 47, 125},
                                        {65, 68, 135},
                                        {57, 86, 140},
                                        {49, 104, 142},
                                        {42, 120, 142},
                                        {35, 136, 142},
                                        {31, 152, 139},
                                        {34, 168, 132},
                                        {53, 183, 121},
                                        {84, 197, 104},
                                        {122, 209, 81},
                                        {165, 219, 54},
                                        {210, 226, 27},
                                        {253, 231, 37}}};

std::uint8_t to_byte(double unit) { return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(unit, 0.0, 1.0))); }

}  // namespace

Rgb8 velocity_rgb(const Eigen::Vector3d& velocity, double v_max) {
  const Eigen::Vector3d c = (0.5 + 0.5 * velocity.array() / v_max).matrix();
  return {to_byte(c.x()), to_byte(c.y()), to_byte(c.z())};
}

Rgb8 magnitude_rgb(double t) {
  const double place = std::clamp(t, 0.0, 1.0) * (viridis.size() - 1);
  const std::size_t low = std::min<std::size_t>(static_cast<std::size_t>(place), viridis.size() - 2);
  const double share = place - static_cast<double>(low);
  Rgb8 colour;
  for (std::size_t c = 0; c < colour.size(); ++c)
    colour[c] = static_cast<std::uint8_t>(std::lround((1.0 - share) * viridis[low][c] + share * viridis[low + 1][c]));
  return colour;
}

Rgb8 colour_along(VelocityColour colour, int axis, double t) {
  if (colour == VelocityColour::magnitude) return magnitude_rgb(t);
  return velocity_rgb((2.0 * t - 1.0) * Eigen::Vector3d::Unit(axis), 1.0);
}

}  // namespace billow::render
