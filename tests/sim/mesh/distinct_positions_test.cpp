// The same answers as looking at every position.
#include "sim/mesh/distinct_positions.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace billow::sim {
namespace {

constexpr double tolerance = 0.01;

int nearest_by_hand(const std::vector<Eigen::Vector3d>& known, const Eigen::Vector3d& point) {
  int nearest = -1;
  for (int k = 0; k < static_cast<int>(known.size()); ++k) {
    const double distance = (known[k] - point).norm();
    if (distance <= tolerance && (nearest < 0 || distance < (known[nearest] - point).norm())) nearest = k;
  }
  return nearest;
}

// Crowded enough that most points have several positions around them.
TEST(DistinctPositions, FindsTheNearestOfAllWithinItsTolerance) {
  const Eigen::MatrixX3d points = 0.05 * seeded_noise(2000, 5);
  DistinctPositions distinct(points.row(0), tolerance);
  std::vector<Eigen::Vector3d> known;
  for (int r = 0; r < points.rows(); ++r) {
    const Eigen::Vector3d point = points.row(r);
    const int expected = nearest_by_hand(known, point);
    EXPECT_EQ(distinct.find(point), expected);
    EXPECT_EQ(distinct.find_or_add(point), expected < 0 ? static_cast<int>(known.size()) : expected);
    if (expected < 0) known.push_back(point);
  }
  EXPECT_GT(known.size(), 64u);  // enough to need more room than there is at first
  for (int k = 0; k < static_cast<int>(known.size()); ++k) EXPECT_EQ(distinct.find(known[k]), k);
}

TEST(DistinctPositions, FindsNothingBeforeTheFirst) {
  EXPECT_EQ(DistinctPositions(Eigen::Vector3d::Zero(), tolerance).find(Eigen::Vector3d::Zero()), -1);
}

}  // namespace
}  // namespace billow::sim
