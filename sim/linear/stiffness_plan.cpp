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

// By block, then by the distance between the ends, then by particle: the springs of a run come one after another.
std::vector<int> by_distance(const Structure& structure) {
  std::vector<int> order(structure.springs());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int s) {
    return std::tuple(block_of(structure, s), distance(structure, s), structure.spring(s, 0), s);
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  return order;
}

bool continues(const Structure& structure, int spring, int next) {
  const int way = structure.spring(next, 0) - structure.spring(spring, 0);
  return block_of(structure, next) == block_of(structure, spring) &&
         distance(structure, next) == distance(structure, spring) && way > 0 && way <= 1 + widest_gap;
}

bool before(const Structure& structure, int a, int b) {
  return std::tuple(structure.spring(a, 0), structure.spring(a, 1), a) <
         std::tuple(structure.spring(b, 0), structure.spring(b, 1), b);
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
  std::sort(loose.begin(), loose.end(), [&](int a, int b) { return before(structure, a, b); });
  lay_loose(structure, loose);
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
