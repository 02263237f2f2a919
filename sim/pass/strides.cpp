// Counting distances.
#include "sim/pass/strides.h"

#include <algorithm>

namespace billow::sim {

namespace {

constexpr std::size_t most_strides = 24;
constexpr double least_taken = 0.75;  // share of the places

}  // namespace

std::vector<int> common_strides(const std::vector<std::pair<int, int>>& pairs, int particles) {
  std::vector<int> distance;
  distance.reserve(pairs.size());
  for (const auto& [i, j] : pairs) distance.push_back(j - i);
  std::sort(distance.begin(), distance.end());
  distance.erase(std::unique(distance.begin(), distance.end()), distance.end());
  const double places = static_cast<double>(distance.size()) * particles;
  const bool regular = distance.size() <= most_strides && static_cast<double>(pairs.size()) >= least_taken * places;
  const bool distinct = std::adjacent_find(pairs.begin(), pairs.end()) == pairs.end();
  return regular && distinct ? distance : std::vector<int>{};
}

}  // namespace billow::sim
