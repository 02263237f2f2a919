// What bands hold for each particle, in groups of particles, those of equal groups once.
#pragma once

#include <cstddef>
#include <span>

#include "base/aligned.h"

namespace billow::sim {

/// Bands take particles in groups of this many, whatever the processor's vectors hold: 2, 4 or 8 doubles.
constexpr int band_group = 16;

/// The number of groups of `particles`, the last of them perhaps not full.
constexpr std::size_t band_groups(int particles) {
  return static_cast<std::size_t>((particles + band_group - 1) / band_group);
}

/// Some rows of band_group numbers each, one per particle of the group.
struct BandGroup {
  std::size_t begin = 0;  // the first number's place
  bool uniform = false;   // whether the numbers of each row are known to be the same
};

/// Lets groups whose `rows` rows hold the same bits share one place, so that a pass over a large regular body finds
/// them in the cache, and finds the uniform ones.
void share_equal_groups(const AlignedVector<double>& value, std::size_t rows, std::span<BandGroup> groups);

}  // namespace billow::sim
