// Percentiles in bounded memory.
#include "cli/run/component_histogram.h"

#include <gtest/gtest.h>

namespace billow::cli {
namespace {

TEST(ComponentHistogram, FindsPercentilesWithinFourPercent) {
  ComponentHistogram histogram;
  Eigen::MatrixX3d velocity(1000, 3);
  for (int i = 0; i < 3000; ++i) velocity.data()[i] = (i % 2 ? -1.0 : 1.0) * (i + 1) / 3000.0;  // |v| spread evenly
  histogram.add(velocity.topRows(500));
  histogram.add(velocity.bottomRows(500));
  for (const double share : {0.01, 0.25, 0.5, 0.9, 0.99, 1.0}) {
    EXPECT_GE(histogram.percentile(share), share - 1e-12);
    EXPECT_LE(histogram.percentile(share), 1.04 * share + 1e-3);
  }
}

TEST(ComponentHistogram, LeavesOutWhatIsAtRest) {
  ComponentHistogram histogram;
  EXPECT_EQ(histogram.percentile(0.99), 0.0);
  Eigen::MatrixX3d velocity = Eigen::MatrixX3d::Zero(100, 3);
  histogram.add(velocity);
  EXPECT_EQ(histogram.percentile(0.99), 0.0);
  velocity(7, 1) = -2.0;
  histogram.add(velocity);
  EXPECT_GE(histogram.percentile(0.99), 2.0);
  EXPECT_LE(histogram.percentile(0.99), 2.1);
}

}  // namespace
}  // namespace billow::cli
