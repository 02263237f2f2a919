// Groups of equal numbers share one place.
#include "sim/pass/band_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sim/body/cloth.h"
#include "sim/import/mesh_import.h"
#include "sim/pass/spring_plan.h"

namespace billow::sim {
namespace {

TEST(BandGroups, ShareOnePlaceWhereTheyHoldTheSameBits) {
  constexpr std::size_t rows = 2, size = rows * band_group;
  AlignedVector<double> value(4 * size, 1.0);
  value[size + 3] = 2.0;                                         // one particle differs
  for (int k = 0; k < band_group; ++k) value[2 * size + k] = 5;  // a row differs, all of it
  std::vector<BandGroup> groups = {{0}, {size}, {2 * size}, {3 * size}};
  share_equal_groups(value, rows, groups);
  EXPECT_EQ(groups[3].begin, 0u);
  EXPECT_EQ(groups[1].begin, size);
  EXPECT_EQ(groups[2].begin, 2 * size);
  EXPECT_TRUE(groups[0].uniform && groups[2].uniform && groups[3].uniform);
  EXPECT_FALSE(groups[1].uniform);
}

// A drape's rest lengths are read from the cache.
TEST(BandGroups, OfARegularClothFromAFileAreMostlyShared) {
  const Structure cloth = build_cloth(import_mesh(BILLOW_SOURCE_DIR "/assets/meshes/cloth_100.obj"), {});
  const SpringPlan plan(cloth);
  ASSERT_EQ(plan.bands.size(), 1u);
  std::vector<std::size_t> places;
  for (const BandGroup& group : plan.bands[0].group) places.push_back(group.begin);
  std::sort(places.begin(), places.end());
  EXPECT_LT(std::unique(places.begin(), places.end()) - places.begin(), 64) << "of 625";
}

}  // namespace
}  // namespace billow::sim
