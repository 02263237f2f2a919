// How large the components of many velocities are, in memory that does not grow with their number.
#pragma once

#include <Eigen/Core>
#include <array>

namespace billow::cli {

/// Counts |v| of every component in bins a thirty-second of an octave wide.
class ComponentHistogram {
 public:
  /// (n x 3) [m/s].
  void add(const Eigen::MatrixX3d& velocity);
  /// [m/s] The upper end of the bin that reaches the `share` of all components in (0, 1], those at rest left out; 0
  /// where there are none. At most 4 % above the exact value.
  double percentile(double share) const;

 private:
  static constexpr int per_octave = 32, octaves = 80, first_octave = -40;
  static int bin_of(double size);

  std::array<long, per_octave * octaves> count_{};
  long total_ = 0;
};

}  // namespace billow::cli
