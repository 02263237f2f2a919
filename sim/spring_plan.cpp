// Structure -> bands and slices.
#include "sim/spring_plan.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>
#include <utility>

#include "sim/locality.h"
#include "sim/strides.h"

namespace billow::sim {

namespace {

/// The springs of one body with ends counted from its first particle, the lower first, sorted by them.
struct LocalSprings {
  std::vector<std::pair<int, int>> ends;
  std::vector<int> spring;  // in the structure
};

LocalSprings local_springs(const Structure& structure, const Body& body) {
  LocalSprings local;
  local.spring.resize(static_cast<std::size_t>(body.springs));
  std::iota(local.spring.begin(), local.spring.end(), body.first_spring);
  const auto ends = [&](int s) {
    const int i = structure.spring(s, 0) - body.first_particle, j = structure.spring(s, 1) - body.first_particle;
    return std::pair(std::min(i, j), std::max(i, j));
  };
  std::stable_sort(local.spring.begin(), local.spring.end(), [&](int a, int b) { return ends(a) < ends(b); });
  for (const int s : local.spring) local.ends.push_back(ends(s));
  return local;
}

// The springs as bands, if those of each stride are of one material; otherwise bands without strides.
SpringBands make_bands(const Structure& structure, const Body& body, const LocalSprings& local) {
  SpringBands bands;
  bands.first_particle = body.first_particle;
  bands.particles = body.particles;
  bands.damped = is_damped(structure, body);
  bands.damping_model = body.damping_model;
  bands.stride = common_strides(local.ends, body.particles);
  const std::size_t strides = bands.stride.size();
  bands.stiffness.assign(strides, -1.0);
  bands.damping.assign(strides, -1.0);
  bands.rest_length.assign(
      static_cast<std::size_t>(body.particles + band_group - 1) / band_group * strides * band_group, 0.0);
  const auto agrees = [](double& shared, double own) {
    if (shared < 0.0) shared = own;
    return shared == own;
  };
  for (std::size_t e = 0; strides > 0 && e < local.ends.size(); ++e) {
    const std::size_t i = static_cast<std::size_t>(local.ends[e].first);
    const int s = local.spring[e], stride = local.ends[e].second - local.ends[e].first;
    const std::size_t k = static_cast<std::size_t>(std::lower_bound(bands.stride.begin(), bands.stride.end(), stride) -
                                                   bands.stride.begin());
    bands.rest_length[(i / band_group * strides + k) * band_group + i % band_group] = structure.rest_length(s);
    if (!agrees(bands.stiffness[k], structure.stiffness(s)) || !agrees(bands.damping[k], structure.damping(s)))
      return {};
  }
  return bands;
}

constexpr int lanes = 4;           // springs in a quad, particles in a slice
constexpr int block_slices = 512;  // at least: 2048 particles, some hundred kilobytes

void append_springs(const Structure& structure, const LocalSprings& local, SpringSlices& slices) {
  for (std::size_t e = 0; e < local.ends.size(); ++e) {
    slices.first.push_back(local.ends[e].first);
    slices.second.push_back(local.ends[e].second);
    slices.rest_length.push_back(structure.rest_length(local.spring[e]));
    slices.stiffness.push_back(structure.stiffness(local.spring[e]));
    slices.damping.push_back(structure.damping(local.spring[e]));
  }
  while (slices.first.size() % lanes != 0) {  // a spring of no stiffness at the last one's place
    slices.first.push_back(slices.first.back());
    slices.second.push_back(slices.second.back());
    slices.rest_length.push_back(1.0);
    slices.stiffness.push_back(0.0);
    slices.damping.push_back(0.0);
  }
}

/// For every particle, the springs that start and that end in it, ascending.
struct Incidence {
  std::vector<std::vector<int>> starting, ending;
};

Incidence incidence(const LocalSprings& local, int particles) {
  Incidence at{std::vector<std::vector<int>>(static_cast<std::size_t>(particles)),
               std::vector<std::vector<int>>(static_cast<std::size_t>(particles))};
  for (std::size_t e = 0; e < local.ends.size(); ++e) {
    at.starting[static_cast<std::size_t>(local.ends[e].first)].push_back(static_cast<int>(e));
    at.ending[static_cast<std::size_t>(local.ends[e].second)].push_back(static_cast<int>(e));
  }
  return at;
}

// Four lists side by side, the shorter ones filled up with `filler`.
int append_side_by_side(const std::vector<std::vector<int>>& lists, int slice, std::uint32_t mask, std::uint32_t filler,
                        std::vector<std::uint32_t>& entry) {
  const auto list = [&](int lane) -> const std::vector<int>& {
    static const std::vector<int> none;
    const std::size_t row = static_cast<std::size_t>(lanes * slice + lane);
    return row < lists.size() ? lists[row] : none;
  };
  std::size_t longest = 0;
  for (int lane = 0; lane < lanes; ++lane) longest = std::max(longest, list(lane).size());
  for (std::size_t k = 0; k < longest; ++k)
    for (int lane = 0; lane < lanes; ++lane)
      entry.push_back(k < list(lane).size() ? (static_cast<std::uint32_t>(list(lane)[k]) & mask) * 4 : filler);
  return static_cast<int>(longest);
}

// The springs that particles [0, 4 t + 4) start, in whole quads.
std::vector<int> quads_before(const LocalSprings& local, int slice_count) {
  std::vector<int> quads(static_cast<std::size_t>(slice_count));
  std::size_t e = 0;
  for (int t = 0; t < slice_count; ++t) {
    while (e < local.ends.size() && local.ends[e].first < lanes * (t + 1)) ++e;
    quads[static_cast<std::size_t>(t)] = static_cast<int>((e + lanes - 1) / lanes);
  }
  return quads;
}

// The first spring that each slice's sums need.
std::vector<int> earliest_springs(const Incidence& at, const std::vector<int>& quads) {
  std::vector<int> earliest(quads.size());
  for (std::size_t t = 0; t < quads.size(); ++t) {
    earliest[t] = lanes * quads[t];
    for (std::size_t row = lanes * t; row < std::min(lanes * (t + 1), at.ending.size()); ++row) {
      if (!at.starting[row].empty()) earliest[t] = std::min(earliest[t], at.starting[row].front());
      if (!at.ending[row].empty()) earliest[t] = std::min(earliest[t], at.ending[row].front());
    }
  }
  return earliest;
}

int last_quad_for(const SpringSlices& slices, int slice) {
  const int last = static_cast<int>(slices.slice_quads.size()) - 1;
  return slices.slice_quads[static_cast<std::size_t>(std::min(slice + slice_lead, last))];
}

SpringSlices::Block make_block(const SpringSlices& slices, const std::vector<int>& earliest, int begin, int end) {
  SpringSlices::Block block{begin, end, 0, lanes * begin, std::min(lanes * end, slices.particles)};
  const int first_spring = *std::min_element(earliest.begin() + begin, earliest.begin() + end);
  block.first_quad = first_spring / lanes;
  for (int s = lanes * block.first_quad; s < lanes * slices.slice_quads[static_cast<std::size_t>(end - 1)]; ++s) {
    block.low = std::min(block.low, slices.first[static_cast<std::size_t>(s)]);
    block.high = std::max(block.high, slices.second[static_cast<std::size_t>(s)] + 1);
  }
  return block;
}

// A block repeats the springs that reach into it from before, so it should be long compared with that reach.
int slices_per_block(const SpringSlices& slices) {
  int reach = 0;
  for (std::size_t s = 0; s < slices.first.size(); ++s) reach = std::max(reach, slices.second[s] - slices.first[s]);
  return std::max(block_slices, 4 * reach / lanes);
}

// Ends as places in `order`.
LocalSprings renumbered(LocalSprings local, const std::vector<int>& order) {
  if (order.empty()) return local;
  const std::vector<int> rank = ranks(order);
  std::vector<std::pair<std::pair<int, int>, int>> keyed;
  for (std::size_t e = 0; e < local.ends.size(); ++e) {
    const int i = rank[static_cast<std::size_t>(local.ends[e].first)];
    const int j = rank[static_cast<std::size_t>(local.ends[e].second)];
    keyed.emplace_back(std::minmax(i, j), local.spring[e]);
  }
  std::sort(keyed.begin(), keyed.end());
  for (std::size_t e = 0; e < keyed.size(); ++e) std::tie(local.ends[e], local.spring[e]) = keyed[e];
  return local;
}

SpringSlices make_slices(const Structure& structure, const Body& body, const LocalSprings& as_built) {
  SpringSlices slices;
  slices.order = local_order(as_built.ends, body.particles);
  const LocalSprings local = renumbered(as_built, slices.order);
  slices.first_particle = body.first_particle;
  slices.particles = body.particles;
  slices.damped = is_damped(structure, body);
  slices.damping_model = body.damping_model;
  append_springs(structure, local, slices);
  const int count = (body.particles + lanes - 1) / lanes;
  const Incidence at = incidence(local, body.particles);
  slices.slice_quads = quads_before(local, count);
  const std::vector<int> earliest = earliest_springs(at, slices.slice_quads);
  unsigned waiting = lanes;
  for (int t = 0; t < count; ++t)
    waiting = std::max(waiting,
                       static_cast<unsigned>(lanes * last_quad_for(slices, t) - earliest[static_cast<std::size_t>(t)]));
  slices.ring = static_cast<int>(std::bit_ceil(waiting));
  const std::uint32_t mask = static_cast<std::uint32_t>(slices.ring) - 1;
  const std::uint32_t zero = static_cast<std::uint32_t>(slices.ring) * 4;
  for (int t = 0; t < count; ++t) {
    slices.entry_begin.push_back(static_cast<int>(slices.entry.size()));
    slices.plus.push_back(append_side_by_side(at.starting, t, mask, zero, slices.entry));
    append_side_by_side(at.ending, t, mask, zero, slices.entry);
  }
  slices.entry_begin.push_back(static_cast<int>(slices.entry.size()));
  const int step = slices_per_block(slices);
  for (int t = 0; t < count; t += step)
    slices.block.push_back(make_block(slices, earliest, t, std::min(t + step, count)));
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
