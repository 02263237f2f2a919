// Structure -> bands and slices.
#include "sim/pass/spring_plan.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "sim/pass/locality.h"
#include "sim/pass/strides.h"

namespace billow::sim {

namespace {

/// The springs of one body with ends counted from its first particle, the lower first, sorted by them.
struct LocalSprings {
  std::vector<std::pair<int, int>> ends;
  std::vector<int> spring;  // in the structure
};

LocalSprings local_springs(const Structure& structure, const Body& body) {
  std::vector<std::pair<std::pair<int, int>, int>> sorted;  // by ends, then by number
  sorted.reserve(static_cast<std::size_t>(body.springs));
  for (int s = body.first_spring; s < body.first_spring + body.springs; ++s) {
    const int i = structure.spring(s, 0) - body.first_particle, j = structure.spring(s, 1) - body.first_particle;
    sorted.emplace_back(std::minmax({i, j}), s);
  }
  std::sort(sorted.begin(), sorted.end());
  LocalSprings local;
  for (const auto& [ends, spring] : sorted) local.ends.push_back(ends), local.spring.push_back(spring);
  return local;
}

std::size_t stride_index(const SpringBands& bands, int stride) {
  return static_cast<std::size_t>(std::lower_bound(bands.stride.begin(), bands.stride.end(), stride) -
                                  bands.stride.begin());
}

// Bands with room for every particle's spring of every stride, and no spring in it yet.
SpringBands empty_bands(const Structure& structure, const Body& body, std::vector<int> stride) {
  SpringBands bands;
  bands.first_particle = body.first_particle;
  bands.particles = body.particles;
  bands.damped = is_damped(structure, body);
  bands.damping_model = body.damping_model;
  bands.stride = std::move(stride);
  const std::size_t groups = band_groups(body.particles), rows = bands.stride.size() * band_group;
  bands.rest_length.assign(groups * rows, 0.0);
  for (std::size_t g = 0; g < groups; ++g) bands.group.push_back({g * rows});
  return bands;
}

// False where a spring is of another material than those of its stride before it.
bool fill_bands(const Structure& structure, const LocalSprings& local, SpringBands& bands) {
  constexpr double unknown = -1.0;
  bands.stiffness.assign(bands.stride.size(), unknown);
  bands.damping.assign(bands.stride.size(), unknown);
  const auto agrees = [](double& shared, double own) {
    if (shared == unknown) shared = own;
    return shared == own;
  };
  for (std::size_t e = 0; e < local.ends.size(); ++e) {
    const auto [first, second] = local.ends[e];
    const std::size_t i = static_cast<std::size_t>(first), k = stride_index(bands, second - first);
    const int s = local.spring[e];
    bands.rest_length[bands.group[i / band_group].begin + k * band_group + i % band_group] = structure.rest_length(s);
    if (!agrees(bands.stiffness[k], structure.stiffness(s)) || !agrees(bands.damping[k], structure.damping(s)))
      return false;
  }
  return true;
}

// The springs as bands, if they lie in few strides and those of each are of one material; otherwise bands without any.
SpringBands make_bands(const Structure& structure, const Body& body, const LocalSprings& local) {
  std::vector<int> stride = common_strides(local.ends, body.particles);
  if (stride.empty()) return {};
  SpringBands bands = empty_bands(structure, body, std::move(stride));
  if (!fill_bands(structure, local, bands)) return {};
  share_equal_groups(bands.rest_length, bands.stride.size(), bands.group);
  return bands;
}

/// A spring as its owner sees it.
struct OwnedSpring {
  int other = 0;   // particle of the body
  int spring = 0;  // in the structure
};
using Owned = std::vector<std::vector<OwnedSpring>>;

// Every spring to that of its ends which owns fewer.
Owned shared_out(const LocalSprings& local, int particles) {
  Owned owned(static_cast<std::size_t>(particles));
  for (std::size_t e = 0; e < local.ends.size(); ++e) {
    const auto [i, j] = local.ends[e];
    const bool first = owned[static_cast<std::size_t>(i)].size() <= owned[static_cast<std::size_t>(j)].size();
    owned[static_cast<std::size_t>(first ? i : j)].push_back({first ? j : i, local.spring[e]});
  }
  return owned;
}

// Within windows of the order, particles that own many first: then those of a slice own equally many.
void even_out(const Owned& owned, std::vector<int>& order) {
  constexpr std::ptrdiff_t window = 128;
  const auto more = [&](int a, int b) {
    return owned[static_cast<std::size_t>(a)].size() > owned[static_cast<std::size_t>(b)].size();
  };
  for (auto begin = order.begin(); begin != order.end();) {
    const auto end = order.end() - begin > window ? begin + window : order.end();
    std::stable_sort(begin, end, more);
    begin = end;
  }
}

// A slice's springs so that those to the same particle are far apart: a sum that was stored just before makes the next
// that is added to it wait. Each takes of its springs the one to the particle that had its turn longest ago.
void spread_out(const std::vector<int>& order, Owned& owned) {
  std::vector<int> turn(owned.size(), -1);
  int now = 0;
  const auto take_turn = [&](std::vector<OwnedSpring>& springs, std::size_t k) {
    const auto turn_of = [&](const OwnedSpring& spring) { return turn[static_cast<std::size_t>(spring.other)]; };
    const auto begin = springs.begin() + static_cast<std::ptrdiff_t>(k);
    const auto chosen = std::min_element(
        begin, springs.end(), [&](const OwnedSpring& a, const OwnedSpring& b) { return turn_of(a) < turn_of(b); });
    std::rotate(begin, chosen, chosen + 1);
    turn[static_cast<std::size_t>(begin->other)] = now++;
  };
  for (std::size_t first = 0; first < order.size(); first += slice_lanes) {
    const std::size_t end = std::min(first + slice_lanes, order.size());
    bool more = true;
    for (std::size_t k = 0; more; ++k) {
      more = false;
      for (std::size_t p = first; p < end; ++p)
        if (std::vector<OwnedSpring>& springs = owned[static_cast<std::size_t>(order[p])]; k < springs.size())
          take_turn(springs, k), more = true;
    }
    for (std::size_t p = first; p < end; ++p) turn[static_cast<std::size_t>(order[p])] = now;
  }
}

int farthest(const Owned& owned, const std::vector<int>& place) {
  int reach = 0;
  for (std::size_t i = 0; i < owned.size(); ++i)
    for (const OwnedSpring& spring : owned[i])
      reach = std::max(reach,
                       std::abs(place[i] / slice_lanes - place[static_cast<std::size_t>(spring.other)] / slice_lanes));
  return reach;
}

// The springs of the four particles of slice t side by side; fewer than others' are filled up with ones to itself.
void append_slice(const Structure& structure, const Owned& owned, const std::vector<int>& place, int t,
                  SpringSlices& slices) {
  const auto particle = [&](int lane) {
    const int p = slice_lanes * t + lane;
    return p < slices.particles ? slices.order[static_cast<std::size_t>(p)] : -1;
  };
  const std::size_t row = slice_row(slices.damped);
  std::size_t longest = 1;
  for (int lane = 0; lane < slice_lanes; ++lane)
    if (particle(lane) >= 0) longest = std::max(longest, owned[static_cast<std::size_t>(particle(lane))].size());
  for (std::size_t k = 0; k < longest; ++k)
    for (int lane = 0; lane < slice_lanes; ++lane) {
      const int i = particle(lane);
      const bool real = i >= 0 && k < owned[static_cast<std::size_t>(i)].size();
      const OwnedSpring spring = real ? owned[static_cast<std::size_t>(i)][k] : OwnedSpring{};
      const int end = real ? place[static_cast<std::size_t>(spring.other)] : slice_lanes * t + lane;
      slices.other.push_back(static_cast<std::uint32_t>(static_cast<std::size_t>(end & (slices.ring - 1)) * row));
      slices.rest_length.push_back(real ? structure.rest_length(spring.spring) : 0.0);
      slices.stiffness.push_back(real ? structure.stiffness(spring.spring) : 0.0);
      slices.damping.push_back(real ? structure.damping(spring.spring) : 0.0);
    }
  slices.begin.push_back(static_cast<int>(slices.other.size()) / slice_lanes);
}

SpringSlices make_slices(const Structure& structure, const Body& body, const LocalSprings& local) {
  SpringSlices slices;
  slices.first_particle = body.first_particle;
  slices.particles = body.particles;
  slices.damped = is_damped(structure, body);
  slices.damping_model = body.damping_model;
  slices.slices = (body.particles + slice_lanes - 1) / slice_lanes;
  slices.order = local_order(local.ends, body.particles);
  if (slices.order.empty()) {
    slices.order.resize(static_cast<std::size_t>(body.particles));
    std::iota(slices.order.begin(), slices.order.end(), 0);
  }
  Owned owned = shared_out(local, body.particles);
  even_out(owned, slices.order);
  const std::vector<int> place = ranks(slices.order);
  for (std::vector<OwnedSpring>& springs : owned)
    std::stable_sort(springs.begin(), springs.end(), [&](const OwnedSpring& a, const OwnedSpring& b) {
      return place[static_cast<std::size_t>(a.other)] < place[static_cast<std::size_t>(b.other)];
    });
  spread_out(slices.order, owned);
  slices.reach = farthest(owned, place);
  slices.ring = static_cast<int>(std::bit_ceil(static_cast<unsigned>(slice_lanes * (2 * slices.reach + 2))));
  slices.begin.push_back(0);
  for (int t = 0; t < slices.slices; ++t) append_slice(structure, owned, place, t, slices);
  slices.other.resize(slices.other.size() + slice_lanes, 0);
  return slices;
}

}  // namespace

SpringPlan::SpringPlan(const Structure& structure) {
  for (std::size_t b = 0; b < structure.body.size(); ++b) {
    const Body& body = structure.body[b];
    if (body.spring_model != SpringModel::linear || body.springs == 0) {
      others.push_back(static_cast<int>(b));
      continue;
    }
    const LocalSprings local = local_springs(structure, body);
    SpringBands regular = make_bands(structure, body, local);
    if (regular.stride.empty())
      slices.push_back(make_slices(structure, body, local)), slices.back().body = static_cast<int>(b);
    else
      bands.push_back(std::move(regular)), bands.back().body = static_cast<int>(b);
  }
}

}  // namespace billow::sim
