// Pairs -> rows.
#include "sim/filter/filter_neighbours.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "sim/mesh/regular_values.h"

namespace billow::sim {

namespace {

using Pair = std::pair<int, int>;

// Both directions of every spring.
std::vector<Pair> spring_neighbours(const Structure& structure) {
  std::vector<Pair> pairs;
  pairs.reserve(2 * structure.springs());
  for (int s = 0; s < structure.springs(); ++s) {
    pairs.emplace_back(structure.spring(s, 0), structure.spring(s, 1));
    pairs.emplace_back(structure.spring(s, 1), structure.spring(s, 0));
  }
  return pairs;
}

// A regular cloth has neighbours at exactly a round radius; this share more lets none of them come and go with the
// rounding of a mesh file's decimals.
constexpr double radius_slack = 1e-4;

// All pairs of one body within `radius` [m] at rest: a sweep along x.
void append_pairs_within(const Structure& structure, const Body& body, double radius, std::vector<Pair>& pairs) {
  std::vector<int> order(body.particles);
  std::iota(order.begin(), order.end(), body.first_particle);
  const auto x = [&](int i) { return structure.rest_position(i, 0); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return std::pair(x(a), a) < std::pair(x(b), b); });
  for (std::size_t a = 0; a < order.size(); ++a)
    for (std::size_t b = a + 1; b < order.size() && x(order[b]) - x(order[a]) <= radius; ++b) {
      const int i = order[a], j = order[b];
      if ((structure.rest_position.row(i) - structure.rest_position.row(j)).norm() > radius) continue;
      pairs.emplace_back(i, j);
      pairs.emplace_back(j, i);
    }
}

std::vector<Pair> neighbour_pairs(const Structure& structure, const FilterOptions& options) {
  std::vector<Pair> pairs;
  if (options.neighbours == FilterNeighbours::springs)
    pairs = spring_neighbours(structure);
  else
    for (const Body& body : structure.body)
      append_pairs_within(structure, body, (1.0 + radius_slack) * options.radius * body.mean_rest_length, pairs);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

FilterNeighbourhood find_neighbours(const Structure& structure, const FilterOptions& options,
                                    const Eigen::VectorXd& unit) {
  FilterNeighbourhood found;
  const std::vector<Pair> pairs = neighbour_pairs(structure, options);
  found.rows.first.assign(structure.particles() + 1, 0);
  for (const auto& [i, j] : pairs) ++found.rows.first[i + 1], found.rows.column.push_back(j);
  std::partial_sum(found.rows.first.begin(), found.rows.first.end(), found.rows.first.begin());
  found.distance.resize(pairs.size());
  for (std::size_t e = 0; e < pairs.size(); ++e) {
    const auto [i, j] = pairs[e];
    found.distance(e) = (structure.rest_position.row(i) - structure.rest_position.row(j)).norm() / unit(i);
  }
  for (const Body& body : structure.body) {
    const int begin = found.rows.first[body.first_particle];
    const int end = found.rows.first[body.first_particle + body.particles];
    make_regular(found.distance.segment(begin, end - begin));
  }
  return found;
}

}  // namespace billow::sim
