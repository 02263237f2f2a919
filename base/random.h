// Seeded noise that is the same on every machine and standard library.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace billow {

/// Uniform numbers in [-1, 1) from the bits of std::mt19937_64, whose sequence the standard fixes (its distributions
/// are not fixed).
inline Eigen::MatrixX3d seeded_noise(int rows, std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  Eigen::MatrixX3d noise(rows, 3);
  for (int i = 0; i < rows; ++i)
    for (int axis = 0; axis < 3; ++axis) noise(i, axis) = static_cast<double>(bits() >> 11) * 0x1p-52 - 1.0;
  return noise;
}

}  // namespace billow
