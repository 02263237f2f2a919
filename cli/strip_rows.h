// What the rows of the velocity strip show.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cli/scene.h"
#include "sim/structure.h"

namespace billow::cli {

/// One body below the other: the particles of a cloth in the strip's order; of a fish, places along its axis from snout
/// to tail, where the sides' breathing in and out cancels and the swimming wave remains.
class StripRows {
 public:
  /// Without rows when the scene has no strip.
  StripRows(const Scene& scene, const sim::Structure& structure);

  /// The rows' velocities [m/s], from those of the particles (n x 3).
  Eigen::MatrixX3d of(const Eigen::MatrixX3d& velocity) const;
  /// 0, 1, 2 …: the rows are already in order.
  std::vector<int> order() const;

 private:
  struct Part {
    std::vector<int> particles;  // in order; of a fish: all of them
    Eigen::MatrixXd weight;      // (rows x particles), or empty: a row for each particle
  };
  std::vector<Part> part_;
  int rows_ = 0;
};

}  // namespace billow::cli
