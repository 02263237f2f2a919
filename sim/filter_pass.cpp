// The filter pass, compiled once for each instruction set; products and sums are rounded one by one and taken in the
// plan's order, so all sets give the same bits.
#include "sim/filter_pass.h"

#include <algorithm>

#include "sim/spring_plan.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/filter_pass.cpp"
#include <hwy/foreach_target.h>
// After foreach_target: it includes the rest of this file again for each instruction set.
#include <hwy/highway.h>

#include "sim/vector_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace billow::sim::HWY_NAMESPACE {

// Four lanes at most: a vector of eight, loaded at any particle, always straddles two cache lines.
using Band = hn::CappedTag<double, 4>;
constexpr int band_lanes = static_cast<int>(hn::MaxLanes(Band()));

/// Columns over some of the particles: entry i is particle i of the body.
struct FieldSegment {
  const double* in[3];
  double* out[3];
};

// Two vectors of particles from i on. Named sums stay in registers.
HWY_INLINE void filter_pair(const FilterBands& bands, const double* weight, const FieldSegment& field, int i) {
  const Band d;
  hn::Vec<Band> x0 = hn::Zero(d), x1 = x0, y0 = x0, y1 = x0, z0 = x0, z1 = x0;
  const double *const x = field.in[0] + i, *const y = field.in[1] + i, *const z = field.in[2] + i;
  for (const int offset : bands.offset) {
    const auto w0 = hn::Load(d, weight), w1 = hn::Load(d, weight + band_lanes);
    const std::ptrdiff_t j0 = offset, j1 = j0 + band_lanes;
    x0 = hn::Add(x0, hn::Mul(w0, hn::LoadU(d, x + j0))), x1 = hn::Add(x1, hn::Mul(w1, hn::LoadU(d, x + j1)));
    y0 = hn::Add(y0, hn::Mul(w0, hn::LoadU(d, y + j0))), y1 = hn::Add(y1, hn::Mul(w1, hn::LoadU(d, y + j1)));
    z0 = hn::Add(z0, hn::Mul(w0, hn::LoadU(d, z + j0))), z1 = hn::Add(z1, hn::Mul(w1, hn::LoadU(d, z + j1)));
    weight += band_group;
  }
  hn::StoreU(x0, d, field.out[0] + i), hn::StoreU(x1, d, field.out[0] + i + band_lanes);
  hn::StoreU(y0, d, field.out[1] + i), hn::StoreU(y1, d, field.out[1] + i + band_lanes);
  hn::StoreU(z0, d, field.out[2] + i), hn::StoreU(z1, d, field.out[2] + i + band_lanes);
}

// Whole groups from `begin` to `end`.
void filter_groups(const FilterBands& bands, const double* weights, const FieldSegment& field, int begin, int end) {
  for (int i = begin; i < end; i += band_group)
    for (int k = 0; k < band_group; k += 2 * band_lanes)
      filter_pair(bands, weights + static_cast<std::size_t>(i) * bands.offset.size() + k, field, i + k);
}

/// Room that a thread keeps from pass to pass.
AlignedVector<double>& room(std::size_t doubles) {
  static thread_local AlignedVector<double> memory;
  memory.assign(doubles, 0.0);
  return memory;
}

// Particles near a body's ends, on copies with zeros beyond those ends.
void filter_edge(const FilterBands& bands, const double* weights, const FieldSegment& whole, int begin, int end) {
  if (begin >= end) return;
  const int last = (end + band_group - 1) / band_group * band_group;
  const int low = begin + bands.offset.front(), rows = last + bands.offset.back() - low;
  AlignedVector<double>& memory = room(static_cast<std::size_t>(6 * rows));
  const int from = std::max(low, 0), to = std::min(low + rows, bands.particles);
  FieldSegment edge;
  for (int axis = 0; axis < 3; ++axis) {
    double* in = memory.data() + axis * rows;
    std::copy(whole.in[axis] + from, whole.in[axis] + to, in + (from - low));
    edge.in[axis] = in - low;
    edge.out[axis] = memory.data() + (3 + axis) * rows - begin;
  }
  filter_groups(bands, weights, edge, begin, last);
  for (int axis = 0; axis < 3; ++axis) std::copy(edge.out[axis] + begin, edge.out[axis] + end, whole.out[axis] + begin);
}

FieldSegment segment_of(const FilterColumns& columns, int first_particle) {
  FieldSegment segment;
  for (int axis = 0; axis < 3; ++axis) {
    segment.in[axis] = columns.in[axis] + first_particle;
    segment.out[axis] = columns.out[axis] + first_particle;
  }
  return segment;
}

void filter_bands(const FilterBands& bands, const AlignedVector<double>& weights, const FilterColumns& columns,
                  int begin, int end) {
  const FieldSegment whole = segment_of(columns, bands.first_particle);
  const double* own = weights.data() + bands.begin;
  const int inner_begin = (-bands.offset.front() + band_group - 1) / band_group * band_group;
  const int inner_end = (bands.particles - bands.offset.back()) / band_group * band_group;
  const int first = std::clamp(inner_begin, begin, end), last = std::clamp(inner_end, first, end);
  if (first == last || last % band_group != 0) return filter_edge(bands, own, whole, begin, end);
  filter_edge(bands, own, whole, begin, first);
  filter_groups(bands, own, whole, first, last);
  filter_edge(bands, own, whole, last, end);
}

#if HWY_MAX_BYTES >= 32

using SliceSums = Vector3<QV>;

HWY_INLINE void filter_slice(const double* weight, const int* column, const int* end, const double* rows,
                             SliceSums& sums) {
  const Quad d;
  QV a = hn::Zero(d), b = a, c = a, e = a;
  const auto term = [&](int k) HWY_ATTR {
    return hn::Mul(hn::Set(d, weight[k]), hn::Load(d, rows + 4 * std::ptrdiff_t{column[k]}));
  };
  for (; column != end; column += 4, weight += 4)
    a = hn::Add(a, term(0)), b = hn::Add(b, term(1)), c = hn::Add(c, term(2)), e = hn::Add(e, term(3));
  sums = transposed({a, b, c, e});
}

HWY_INLINE void store_slice(const SliceSums& sums, double* x, double* y, double* z) {
  const Quad d;
  hn::StoreU(sums.x, d, x), hn::StoreU(sums.y, d, y), hn::StoreU(sums.z, d, z);
}

#else

struct SliceSums {
  double axis[3][4];
};

void filter_slice(const double* weight, const int* column, const int* end, const double* rows, SliceSums& sums) {
  sums = {};
  for (; column != end; column += 4, weight += 4)
    for (int k = 0; k < 4; ++k)
      for (int axis = 0; axis < 3; ++axis) sums.axis[axis][k] += weight[k] * rows[4 * std::ptrdiff_t{column[k]} + axis];
}

void store_slice(const SliceSums& sums, double* x, double* y, double* z) {
  std::copy(sums.axis[0], sums.axis[0] + 4, x);
  std::copy(sums.axis[1], sums.axis[1] + 4, y);
  std::copy(sums.axis[2], sums.axis[2] + 4, z);
}

#endif

void filter_slices(const FilterSlices& slices, const AlignedVector<double>& weights, const FilterColumns& columns,
                   int block) {
  const FieldSegment whole = segment_of(columns, slices.first_particle);
  const FilterSlices::Block& run = slices.block[static_cast<std::size_t>(block)];
  AlignedVector<double>& memory = room(4 * static_cast<std::size_t>(run.high - run.low));
  ordered_rows_of(whole.in, slices.order, run.low, run.high, memory.data());
  const double* rows = memory.data() - 4 * std::ptrdiff_t{run.low};
  for (int t = run.first_slice; t < run.last_slice; ++t) {
    const int* column = slices.column.data() + 4 * std::ptrdiff_t{slices.slice_begin[static_cast<std::size_t>(t)]};
    const int* end = slices.column.data() + 4 * std::ptrdiff_t{slices.slice_begin[static_cast<std::size_t>(t) + 1]};
    SliceSums sums;
    filter_slice(weights.data() + slices.begin + (column - slices.column.data()), column, end, rows, sums);
    if (4 * t + 4 <= slices.particles && slices.order.empty()) {
      store_slice(sums, whole.out[0] + 4 * t, whole.out[1] + 4 * t, whole.out[2] + 4 * t);
      continue;
    }
    double last[3][4];
    store_slice(sums, last[0], last[1], last[2]);
    for (int k = 0; k < 4 && 4 * t + k < slices.particles; ++k) {
      const int i = slices.order.empty() ? 4 * t + k : slices.order[static_cast<std::size_t>(4 * t + k)];
      for (int axis = 0; axis < 3; ++axis) whole.out[axis][i] = last[axis][k];
    }
  }
}

}  // namespace billow::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace billow::sim {

HWY_EXPORT(filter_bands);
HWY_EXPORT(filter_slices);

void filter_bands(const FilterBands& bands, const AlignedVector<double>& weights, const FilterColumns& columns,
                  int begin, int end) {
  HWY_DYNAMIC_DISPATCH(filter_bands)(bands, weights, columns, begin, end);
}

void filter_slices(const FilterSlices& slices, const AlignedVector<double>& weights, const FilterColumns& columns,
                   int block) {
  HWY_DYNAMIC_DISPATCH(filter_slices)(slices, weights, columns, block);
}

}  // namespace billow::sim
#endif
