// Bodies of every sort that levels are built on.
#pragma once

#include <string>
#include <vector>

#include "sim/body/structure.h"

namespace billow::test {

/// A cloth of w x h vertices, every quad cut in two and every vertex moved along the cloth: no grid. Masses follow the
/// areas.
sim::Structure irregular_cloth(int width, int height, std::vector<int> pinned = {});

/// A soft bar of length + 1 rings of four particles.
sim::Structure soft_bar(int length);

/// The bodies of `structure` as one: parts that no spring joins.
sim::Structure as_one_body(sim::Structure structure);

struct LevelBody {
  std::string name;
  sim::Structure structure;
};

/// Of one body each, with uneven masses. Nothing of them is pinned.
std::vector<LevelBody> free_level_bodies();
/// Likewise; particles at the border and inside are.
std::vector<LevelBody> pinned_level_bodies();
std::vector<LevelBody> all_level_bodies();

}  // namespace billow::test
