// Who touches, as far as places alone tell: within one and a half thicknesses of another surface or of a plane.
#include "sim/contact/touching.h"

#include "tests/support/touching_scenes.h"

namespace billow::sim {
namespace {

constexpr double thin = 0.004;  // [m] of cloth and plane

// Of two level sheets, the second a `gap` [m] above the first and half as wide, both above a plane.
Eigen::VectorXd touching_at(double gap, double above_plane, double thickness = thin) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  Collider plane;
  plane.name = "plane", plane.thickness = thickness;
  plane.half_space = HalfSpace{-above_plane * up, up};
  const auto scene =
      test::touching_scene("sheets",
                           {{.mesh = test::flat_sheet(8, 8, 1.0, Eigen::Vector3d::Zero()), .thickness = thickness},
                            {.mesh = test::flat_sheet(4, 4, 0.5, gap * up), .thickness = thickness}},
                           {plane}, 1.0);
  return touching(ContactModel(scene->structure, scene->contact), scene->start);
}

TEST(Touching, EndsAtOneAndAHalfThicknesses) {
  EXPECT_EQ(touching_at(1.51 * thin, 1.0).sum(), 0.0);
  const Eigen::VectorXd near = touching_at(1.49 * thin, 1.0);
  // Of the wide sheet what lies under the narrow one; of that all.
  EXPECT_EQ(near.head(81).sum(), 25.0);
  EXPECT_EQ(near.tail(25).sum(), 25.0);
}

// A plane keeps its own thickness and half of the cloth's.
TEST(Touching, CountsPlanes) {
  const double kept = 1.5 * thin;
  EXPECT_EQ(touching_at(1.0, 1.51 * kept).sum(), 0.0);
  const Eigen::VectorXd near = touching_at(1.0, 1.49 * kept);
  EXPECT_EQ(near.head(81).sum(), 81.0);
  EXPECT_EQ(near.tail(25).sum(), 0.0);
}

// Its own neighbours do not touch a vertex, however thick the cloth is.
TEST(Touching, IsNotBeingNextToEachOther) { EXPECT_EQ(touching_at(1.0, 1.0, 0.2).sum(), 0.0); }

}  // namespace
}  // namespace billow::sim
