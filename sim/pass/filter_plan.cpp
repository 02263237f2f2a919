// Neighbours -> bands and slices.
#include "sim/pass/filter_plan.h"

#include <algorithm>
#include <span>
#include <utility>

#include "sim/pass/locality.h"
#include "sim/pass/strides.h"

namespace billow::sim {

namespace {

constexpr int lanes = FilterSlices::lanes;

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

namespace {

// Blocks of slices, and between which places of the order their particles and neighbours lie.
std::vector<FilterSlices::Block> blocks_of(const FilterSlices& slices) {
  std::vector<FilterSlices::Block> blocks;
  const int count = static_cast<int>(slices.slice_begin.size()) - 1;
  for (int t = 0; t < count; t += FilterSlices::block_slices) {
    const int end = std::min(t + FilterSlices::block_slices, count);
    const auto column = slices.column.begin();
    const auto [low, high] = std::minmax_element(column + lanes * slices.slice_begin[static_cast<std::size_t>(t)],
                                                 column + lanes * slices.slice_begin[static_cast<std::size_t>(end)]);
    blocks.push_back({t, end, *low, *high + 1});
  }
  return blocks;
}

}  // namespace

void FilterPlan::add_slices(const Body& body, const NeighbourRows& neighbours, std::vector<int> order) {
  FilterSlices added;
  added.first_particle = body.first_particle;
  added.particles = body.particles;
  added.begin = places_;
  added.slice_begin = {0};
  added.order = std::move(order);
  const std::vector<int> rank = ranks(added.order);
  for (int t = 0; lanes * t < body.particles; ++t) append_slice(neighbours, rank, t, added);
  places_ = (places_ + band_group - 1) / band_group * band_group;
  added.block = blocks_of(added);
  slices.push_back(std::move(added));
}

// The particles themselves, then their first neighbours, then their second ones ... What fills up the last slice stands
// for its last particle, what fills up a particle's row for itself.
void FilterPlan::append_slice(const NeighbourRows& neighbours, const std::vector<int>& rank, int slice,
                              FilterSlices& slices) {
  const auto particle = [&](int row) {
    return slices.first_particle + (slices.order.empty() ? row : slices.order[static_cast<std::size_t>(row)]);
  };
  const auto row_of = [&](int i) {
    return rank.empty() ? i - slices.first_particle : rank[static_cast<std::size_t>(i - slices.first_particle)];
  };
  const auto first = [&](int i) { return neighbours.first[static_cast<std::size_t>(i)]; };
  const int rows = std::min(lanes, slices.particles - lanes * slice);
  int longest = 0;
  for (int lane = 0; lane < rows; ++lane) {
    const int i = particle(lanes * slice + lane);
    longest = std::max(longest, first(i + 1) - first(i));
  }
  for (int k = -1; k < longest; ++k)
    for (int lane = 0; lane < lanes; ++lane, ++places_) {
      const int row = lanes * slice + std::min(lane, rows - 1), i = particle(row), e = first(i) + k;
      const bool real = lane < rows && k >= 0 && e < first(i + 1);
      slices.column.push_back(real ? row_of(neighbours.column[static_cast<std::size_t>(e)]) : row);
      if (real) neighbour_place_[static_cast<std::size_t>(e)] = places_;
      if (lane < rows && k < 0) self_place_[static_cast<std::size_t>(i)] = places_;
    }
  slices.slice_begin.push_back(static_cast<int>(slices.column.size()) / lanes);
}

void FilterPlan::place(const Eigen::VectorXd& self, const Eigen::VectorXd& neighbour, PlacedWeights& placed) const {
  placed.value.assign(places_, 0.0);
  placed.group = group_;
  for (std::size_t i = 0; i < self_place_.size(); ++i)
    placed.value[self_place_[i]] = self(static_cast<Eigen::Index>(i));
  for (std::size_t e = 0; e < neighbour_place_.size(); ++e)
    placed.value[neighbour_place_[e]] = neighbour(static_cast<Eigen::Index>(e));
}

void FilterPlan::share_equal_groups(PlacedWeights& weights) const {
  for (const FilterBands& body : bands)
    billow::sim::share_equal_groups(weights.value, body.offset.size(),
                                    std::span(weights.group).subspan(body.first_group, band_groups(body.particles)));
}

}  // namespace billow::sim
