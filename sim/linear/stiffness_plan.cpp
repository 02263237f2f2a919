// Finding the runs.
#include <algorithm>
#include <numeric>
#include <tuple>

#include "sim/linear/stiffness_product.h"

namespace billow::sim {

namespace {

constexpr int shortest_run = 8;        // [spring] shorter ones cost more than they save
constexpr int widest_gap = 4;          // [spring] a run goes on over a gap of so many
constexpr int block_particles = 2048;  // runs stay within such a block, so that what they read and write stays cached

int block_of(const Structure& structure, int spring) { return structure.spring(spring, 0) / block_particles; }

int distance(const Structure& structure, int spring) {
  return structure.spring(spring, 1) - structure.spring(spring, 0);
}

// In the order of their keys, which end with the spring itself. Keys beside each other: comparing through the structure
// waits for memory at every comparison.
template <class KeyOf>
std::vector<int> sorted_by(const std::vector<int>& springs, const KeyOf& key_of) {
  std::vector<decltype(key_of(0))> keys;
  keys.reserve(springs.size());
  for (const int s : springs) keys.push_back(key_of(s));
  std::sort(keys.begin(), keys.end());
  std::vector<int> order;
  order.reserve(keys.size());
  for (const auto& key : keys) order.push_back(std::get<std::tuple_size_v<decltype(key_of(0))> - 1>(key));
  return order;
}

std::vector<int> all_springs(const Structure& structure) {
  std::vector<int> all(structure.springs());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// By block, then by the distance between the ends, then by particle: the springs of a run come one after another.
std::vector<int> by_distance(const Structure& structure) {
  return sorted_by(all_springs(structure), [&](int s) {
    return std::tuple(block_of(structure, s), distance(structure, s), structure.spring(s, 0), s);
  });
}

bool continues(const Structure& structure, int spring, int next) {
  const int way = structure.spring(next, 0) - structure.spring(spring, 0);
  return block_of(structure, next) == block_of(structure, spring) &&
         distance(structure, next) == distance(structure, spring) && way > 0 && way <= 1 + widest_gap;
}

std::vector<int> by_ends(const Structure& structure, const std::vector<int>& springs) {
  return sorted_by(springs, [&](int s) { return std::tuple(structure.spring(s, 0), structure.spring(s, 1), s); });
}

}  // namespace

ProductPlan::ProductPlan(const Structure& structure) : slot(structure.springs()) {
  const std::vector<int> order = by_distance(structure);
  const int springs = structure.springs();
  std::vector<int> loose;
  first.reserve(springs + springs / 8);
  second.reserve(springs + springs / 8);
  for (int begin = 0, end; begin < springs; begin = end) {
    for (end = begin + 1; end < springs && continues(structure, order[end - 1], order[end]);) ++end;
    if (end - begin >= shortest_run)
      lay_run(structure, &order[begin], end - begin);
    else
      loose.insert(loose.end(), order.begin() + begin, order.begin() + end);
  }
  lay_loose(structure, by_ends(structure, loose));
}

// Gaps stay empty, and so does what fills the last vector up, as far as there are particles.
void ProductPlan::lay_run(const Structure& structure, const int* spring, int count) {
  const int begin = slots(), i = structure.spring(*spring, 0), j = structure.spring(*spring, 1);
  const int length = structure.spring(spring[count - 1], 0) - i + 1;
  const int rounded = std::min((length + 7) / 8 * 8, structure.particles() - j);
  for (int k = 0; k < rounded; ++k) first.push_back(i + k), second.push_back(j + k);
  for (int c = 0; c < count; ++c) slot[spring[c]] = begin + structure.spring(spring[c], 0) - i;
  add_pieces(begin, false);
}

void ProductPlan::lay_loose(const Structure& structure, const std::vector<int>& spring) {
  const int begin = slots();
  for (const int s : spring) {
    slot[s] = slots();
    first.push_back(structure.spring(s, 0)), second.push_back(structure.spring(s, 1));
  }
  add_pieces(begin, true);
}

void ProductPlan::add_pieces(int begin, bool loose) {
  for (int k = begin; k < slots(); k += Piece::max_slots)
    pieces.push_back({k, std::min(Piece::max_slots, slots() - k), first[k], second[k], loose});
}

}  // namespace billow::sim
