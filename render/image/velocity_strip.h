// The RGB velocity-evolution strip (the paper's Figures 3 and 4): one column per sample time, one row per particle.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <vector>

#include "render/image/settings.h"

namespace billow::render {

/// Collects velocity columns and writes them as one lossless PNG. Memory stays constant: columns are spooled to an
/// unnamed temporary file beside the result.
class VelocityStrip {
 public:
  /// `order[r]` is the particle drawn in row r; `velocity_range` the v_max [m/s] of the colours.
  VelocityStrip(const std::filesystem::path& file, std::vector<int> order, double velocity_range);
  ~VelocityStrip();

  /// Appends one column: velocity (n x 3) [m/s].
  void add_column(const Eigen::MatrixX3d& velocity);
  int columns() const;

  /// Writes the picture (columns x rows, one pixel each, not resampled). Throws OutputError.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace billow::render
