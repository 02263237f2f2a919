// Neighbours -> bands and slices.
#include "sim/filter_plan.h"

#include <algorithm>
#include <span>
#include <utility>

#include "sim/locality.h"
#include "sim/strides.h"

namespace billow::sim {

namespace {

constexpr int lanes = 4;
constexpr int block_slices = 512;

std::vector<std::pair<int, int>> upper_pairs(const Body& body, const NeighbourRows& neighbours) {
  std::vector<std::pair<int, int>> pairs;
  for (int i = body.first_particle; i < body.first_particle + body.particles; ++i)
    for (int e = neighbours.first[static_cast<std::size_t>(i)]; e < neighbours.first[static_cast<std::size_t>(i) + 1];
         ++e)
      if (const int j = neighbours.column[static_cast<std::size_t>(e)]; j > i)
        pairs.emplace_back(i - body.first_particle, j - body.first_particle);
  return pairs;
}

}  // namespace

FilterPlan::FilterPlan(const Structure& structure, const NeighbourRows& neighbours)
    : self_place_(static_cast<std::size_t>(structure.particles())), neighbour_place_(neighbours.column.size()) {
  for (const Body& body : structure.body) {
    const std::vector<std::pair<int, int>> pairs = upper_pairs(body, neighbours);
    const std::vector<int> stride = common_strides(pairs, body.particles);
    if (stride.empty())
      add_slices(body, neighbours, local_order(pairs, body.particles));
    else
      add_bands(body, neighbours, stride);
  }
}

void FilterPlan::add_bands(const Body& body, const NeighbourRows& neighbours, const std::vector<int>& stride) {
  FilterBands added{body.first_particle, body.particles, {0}, group_.size()};
  for (const int s : stride) added.offset.push_back(s), added.offset.push_back(-s);
  std::sort(added.offset.begin(), added.offset.end());
  const std::size_t offsets = added.offset.size();
  const auto place = [&](int i, int offset) {
    const auto k = std::lower_bound(added.offset.begin(), added.offset.end(), offset) - added.offset.begin();
    const std::size_t local = static_cast<std::size_t>(i - body.first_particle);
    return places_ + (local / band_group * offsets + static_cast<std::size_t>(k)) * band_group + local % band_group;
  };
  for (int i = body.first_particle; i < body.first_particle + body.particles; ++i) {
    self_place_[static_cast<std::size_t>(i)] = place(i, 0);
    for (int e = neighbours.first[static_cast<std::size_t>(i)]; e < neighbours.first[static_cast<std::size_t>(i) + 1];
         ++e)
      neighbour_place_[static_cast<std::size_t>(e)] = place(i, neighbours.column[static_cast<std::size_t>(e)] - i);
  }
  for (int i = 0; i < body.particles; i += band_group, places_ += band_group * offsets) group_.push_back({places_});
  bands.push_back(std::move(added));
}

void FilterPlan::add_slices(const Body& body, const NeighbourRows& neighbours, std::vector<int> order) {
  FilterSlices added;
  added.first_particle = body.first_particle;
  added.particles = body.particles;
  added.begin = places_;
  added.slice_begin = {0};
  added.order = std::move(order);
  const std::vector<int> rank = ranks(added.order);
  const auto particle = [&](int row) {
    return body.first_particle + (added.order.empty() ? row : added.order[static_cast<std::size_t>(row)]);
  };
  const auto row_of = [&](int i) {
    return rank.empty() ? i - body.first_particle : rank[static_cast<std::size_t>(i - body.first_particle)];
  };
  const auto first = [&](int i) { return neighbours.first[static_cast<std::size_t>(i)]; };
  const int count = (body.particles + lanes - 1) / lanes;
  for (int t = 0; t < count; ++t) {
    const int rows = std::min(lanes, body.particles - lanes * t);
    int longest = 0;
    for (int lane = 0; lane < rows; ++lane) {
      const int i = particle(lanes * t + lane);
      longest = std::max(longest, first(i + 1) - first(i));
    }
    for (int k = -1; k < longest; ++k)  // the particle itself, then its neighbours
      for (int lane = 0; lane < lanes; ++lane, ++places_) {
        const int row = lanes * t + std::min(lane, rows - 1), i = particle(row), e = first(i) + k;
        const bool real = lane < rows && k >= 0 && e < first(i + 1);
        added.column.push_back(real ? row_of(neighbours.column[static_cast<std::size_t>(e)]) : row);
        if (real) neighbour_place_[static_cast<std::size_t>(e)] = places_;
        if (lane < rows && k < 0) self_place_[static_cast<std::size_t>(i)] = places_;
      }
    added.slice_begin.push_back(static_cast<int>(added.column.size()) / lanes);
  }
  places_ = (places_ + band_group - 1) / band_group * band_group;
  for (int t = 0; t < count; t += block_slices) {
    const int end = std::min(t + block_slices, count);
    const auto column = added.column.begin();
    const auto [low, high] = std::minmax_element(column + lanes * added.slice_begin[static_cast<std::size_t>(t)],
                                                 column + lanes * added.slice_begin[static_cast<std::size_t>(end)]);
    added.block.push_back({t, end, *low, *high + 1});
  }
  slices.push_back(std::move(added));
}

PlacedWeights FilterPlan::place(const Eigen::VectorXd& self, const Eigen::VectorXd& neighbour) const {
  PlacedWeights weights{AlignedVector<double>(places_, 0.0), group_};
  for (std::size_t i = 0; i < self_place_.size(); ++i)
    weights.value[self_place_[i]] = self(static_cast<Eigen::Index>(i));
  for (std::size_t e = 0; e < neighbour_place_.size(); ++e)
    weights.value[neighbour_place_[e]] = neighbour(static_cast<Eigen::Index>(e));
  return weights;
}

void FilterPlan::share_equal_groups(PlacedWeights& weights) const {
  for (const FilterBands& body : bands)
    billow::sim::share_equal_groups(weights.value, body.offset.size(),
                                    std::span(weights.group).subspan(body.first_group, band_groups(body.particles)));
}

}  // namespace billow::sim
