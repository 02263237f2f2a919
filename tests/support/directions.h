// A stream of seeded vectors.
#pragma once

#include <Eigen/Core>

#include "base/random.h"

namespace billow::test {

/// Vectors whose components are uniform in [-1, 1), one after another, the same on every machine.
class Directions {
 public:
  explicit Directions(std::uint64_t seed) : rows_(seeded_noise(length, seed)) {}
  Eigen::Vector3d next() { return rows_.row(next_++ % length); }

 private:
  static constexpr int length = 4096;
  Eigen::MatrixX3d rows_;
  int next_ = 0;
};

}  // namespace billow::test
