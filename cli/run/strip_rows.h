// What the rows of the velocity strip show.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cli/scene/scene.h"
#include "sim/body/structure.h"

namespace billow::cli {

/// One body below the other, each as its kind says: the particles of a cloth in the strip's order; of a fish, places
/// along its axis.
class StripRows {
 public:
  /// Without rows when the scene has no strip.
  StripRows(const Scene& scene, const sim::Structure& structure);

  /// The rows' velocities [m/s], from those of the particles (n x 3).
  Eigen::MatrixX3d of(const Eigen::MatrixX3d& velocity) const;
  /// 0, 1, 2 …: the rows are already in order.
  std::vector<int> order() const;

 private:
  std::vector<BodyRows> part_;  // particles of the whole structure
  int rows_ = 0;
};

}  // namespace billow::cli
