// Nearest points against a search over the shapes.
#include "sim/contact/closest_points.h"

#include <gtest/gtest.h>

#include "tests/support/directions.h"

namespace billow::sim {
namespace {

TEST(NearestInTriangle, IsNoFartherThanAnyOfItsPoints) {
  test::Directions random(1);
  for (int trial = 0; trial < 400; ++trial) {
    const Eigen::Vector3d p = random.next(), a = random.next(), b = random.next(),
                          c = trial % 5 == 0 ? Eigen::Vector3d(0.5 * (a + b)) : random.next();
    const Eigen::Vector3d w = nearest_in_triangle(p, a, b, c);
    EXPECT_GE(w.minCoeff(), 0.0);
    EXPECT_NEAR(w.sum(), 1.0, 1e-14);
    const double distance = (w(0) * a + w(1) * b + w(2) * c - p).norm();
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; i + j <= 40; ++j) {
        const double s = i / 40.0, t = j / 40.0;
        EXPECT_LE(distance, ((1.0 - s - t) * a + s * b + t * c - p).norm() + 1e-12);
      }
  }
}

TEST(NearestInTriangle, HasExactZerosOnItsBorder) {
  const Eigen::Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_EQ(nearest_in_triangle({0.5, -1.0, 0.3}, a, b, c)(2), 0.0);
  EXPECT_EQ(nearest_in_triangle({-1.0, -1.0, 0.3}, a, b, c), Eigen::Vector3d(1.0, 0.0, 0.0));
}

TEST(NearestOnSegments, IsNoFartherThanAnyOfTheirPoints) {
  test::Directions random(2);
  for (int trial = 0; trial < 400; ++trial) {
    const Eigen::Vector3d p = random.next(), q = random.next(), r = random.next();
    const Eigen::Vector3d s = trial % 4 == 0 ? Eigen::Vector3d(r + 0.7 * (q - p)) : trial % 7 == 0 ? r : random.next();
    const Eigen::Vector2d at = nearest_on_segments(p, q, r, s);
    EXPECT_GE(at.minCoeff(), 0.0);
    EXPECT_LE(at.maxCoeff(), 1.0);
    const double distance = (p + at(0) * (q - p) - r - at(1) * (s - r)).norm();
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; j <= 40; ++j)
        EXPECT_LE(distance, (p + i / 40.0 * (q - p) - r - j / 40.0 * (s - r)).norm() + 1e-12) << trial;
  }
}

}  // namespace
}  // namespace billow::sim
