// Which springs count, and how.
#include "sim/body/stretch.h"

#include <gtest/gtest.h>

#include "sim/body/fish.h"
#include "tests/support/structures.h"

namespace billow::sim {
namespace {

TEST(Stretch, IsTheLargestAndTheMeanOfStructuralSprings) {
  const Structure chain = test::fixed_chain({.free_particles = 2, .rest_length = 0.5});
  State state = rest_state(chain);
  EXPECT_EQ(stretch_of(chain, state).largest, 0.0);
  state.position(1, 0) = 0.6;  // 0.6, 0.4 and 0.5 m
  const Stretch stretch = stretch_of(chain, state);
  EXPECT_NEAR(stretch.largest, 0.2, 1e-15);
  EXPECT_NEAR(stretch.mean, 0.0, 1e-15);
}

// Sheared, a grid has longer diagonals and no longer edges.
TEST(Stretch, LeavesOtherSpringsOut) {
  const Structure sheet = test::light_cloth(4, 4);
  State state = rest_state(sheet);
  for (int i = 0; i < sheet.particles(); ++i) {
    const double x = state.position(i, 0), z = state.position(i, 2);
    state.position.row(i) << x + 0.6 * z, 0.0, 0.8 * z;
  }
  EXPECT_NEAR(stretch_of(sheet, state).largest, 0.0, 1e-14);
  EXPECT_NEAR(stretch_of(sheet, state).mean, 0.0, 1e-14);
}

TEST(Stretch, OfAFishIsNone) {
  const Structure fish = build_fish({});
  State state = rest_state(fish);
  state.position *= 2.0;
  EXPECT_EQ(stretch_of(fish, state).largest, 0.0);
}

}  // namespace
}  // namespace billow::sim
