// The filter pass, compiled once for each instruction set; products and sums are rounded one by one and taken in the
// plan's order, so all sets give the same bits.
#include "sim/pass/filter_pass.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/pass/filter_pass.cpp"
#include <hwy/foreach_target.h>
// After foreach_target: it includes the rest of this file again for each instruction set.
#include <hwy/highway.h>

#include "sim/pass/vector_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace billow::sim::HWY_NAMESPACE {

/// The columns from a body's first particle on.
FilterColumns columns_from(const FilterColumns& columns, int first_particle) {
  FilterColumns own = columns;
  for (int axis = 0; axis < 3; ++axis) {
    own.in[axis] += first_particle;
    own.out[axis] += first_particle;
    if (own.base[axis]) own.base[axis] += first_particle;
    if (own.moved[axis]) own.moved[axis] += first_particle;
  }
  return own;
}

/// FilterColumns::put on vectors of particles from i on.
template <class D, int vectors, class V = hn::Vec<D>>
HWY_INLINE void put(D d, const FilterColumns& columns, int axis, std::ptrdiff_t i, V (&value)[vectors]) {
  constexpr int lanes = static_cast<int>(hn::MaxLanes(d));
  if (const double* const base = columns.base[axis]) {
    const V step = hn::Set(d, columns.kick_step);
    HWY_UNROLL(4)
    for (int u = 0; u < vectors; ++u) value[u] = hn::Add(hn::LoadU(d, base + i + u * lanes), hn::Mul(step, value[u]));
  }
  double* const out = columns.out[axis] + i;
  HWY_UNROLL(4)
  for (int u = 0; u < vectors; ++u) hn::StoreU(value[u], d, out + u * lanes);
  if (!columns.moved[axis]) return;
  double* const moved = columns.moved[axis] + i;
  const V step = hn::Set(d, columns.move_step);
  HWY_UNROLL(4)
  for (int u = 0; u < vectors; ++u)
    hn::StoreU(hn::Add(hn::LoadU(d, moved + u * lanes), hn::Mul(step, value[u])), d, moved + u * lanes);
}

// Several vectors at once, so that what is read for every offset is read less often; the weights of a uniform group are
// read once for all of them.
template <bool uniform, class D, int vectors = 4>
HWY_INLINE void filter_vectors(D d, const FilterBands& bands, const double* weight, const FilterColumns& field, int i) {
  using V = hn::Vec<D>;
  constexpr int lanes = static_cast<int>(hn::MaxLanes(d));
  V x[vectors], y[vectors], z[vectors];
  HWY_UNROLL(4)
  for (int u = 0; u < vectors; ++u) x[u] = y[u] = z[u] = hn::Zero(d);
  const double* const in[3] = {field.in[0] + i, field.in[1] + i, field.in[2] + i};
  for (const int offset : bands.offset) {
    const double *const in_x = in[0] + offset, *const in_y = in[1] + offset, *const in_z = in[2] + offset;
    const V common = hn::Set(d, *weight);
    HWY_UNROLL(4)
    for (int u = 0; u < vectors; ++u) {
      const V w = uniform ? common : hn::Load(d, weight + u * lanes);
      x[u] = hn::Add(x[u], hn::Mul(w, hn::LoadU(d, in_x + u * lanes)));
      y[u] = hn::Add(y[u], hn::Mul(w, hn::LoadU(d, in_y + u * lanes)));
      z[u] = hn::Add(z[u], hn::Mul(w, hn::LoadU(d, in_z + u * lanes)));
    }
    weight += band_group;
  }
  put(d, field, 0, i, x);
  put(d, field, 1, i, y);
  put(d, field, 2, i, z);
}

// Whole groups from `begin` to `end`.
void filter_groups(const FilterBands& bands, const PlacedWeights& weights, const FilterColumns& field, int begin,
                   int end) {
  const hn::CappedTag<double, 4> d;
  const BandGroup* group = weights.group.data() + bands.first_group + begin / band_group;
  for (int i = begin; i < end; i += band_group, ++group)
    for (int k = 0; k < band_group; k += 4 * static_cast<int>(hn::Lanes(d))) {
      const double* const weight = weights.value.data() + group->begin + k;
      if (group->uniform)
        filter_vectors<true>(d, bands, weight, field, i + k);
      else
        filter_vectors<false>(d, bands, weight, field, i + k);
    }
}

// The same columns, read from copies of what the particles of [begin, end) read, with zeros beyond the body's ends.
FilterColumns with_zeros_beyond(const FilterBands& bands, const FilterColumns& whole, int begin, int end,
                                AlignedVector<double>& memory) {
  const int low = begin + bands.offset.front(), high = end + bands.offset.back(), rows = high - low;
  const int from = std::max(low, 0), to = std::min(high, bands.particles);
  memory.resize(static_cast<std::size_t>(3 * rows));
  FilterColumns columns = whole;
  for (int axis = 0; axis < 3; ++axis) {
    double* const in = memory.data() + axis * rows - low;
    std::fill(in + low, in + from, 0.0);
    std::copy(whole.in[axis] + from, whole.in[axis] + to, in + from);
    std::fill(in + to, in + high, 0.0);
    columns.in[axis] = in;
  }
  return columns;
}

// Particles near a body's ends. What a group holds beyond the body's last particle is filtered to nowhere.
void filter_edge(const FilterBands& bands, const PlacedWeights& weights, const FilterColumns& whole, int begin, int end,
                 PartScratch& scratch) {
  if (begin >= end) return;
  const int last = end / band_group * band_group, beyond = last == end ? end : last + band_group;
  const FilterColumns edge = with_zeros_beyond(bands, whole, begin, beyond, scratch.rows);
  filter_groups(bands, weights, edge, begin, last);
  if (last == end) return;
  double filtered[3][band_group];
  FilterColumns partial{};
  for (int axis = 0; axis < 3; ++axis) partial.in[axis] = edge.in[axis], partial.out[axis] = filtered[axis] - last;
  filter_groups(bands, weights, partial, last, beyond);
  for (int axis = 0; axis < 3; ++axis)
    for (int i = last; i < end; ++i) whole.put(axis, i, filtered[axis][i - last]);
}

void filter_bands(const FilterBands& bands, const PlacedWeights& weights, const FilterColumns& columns, int begin,
                  int end, PartScratch& scratch) {
  const FilterColumns whole = columns_from(columns, bands.first_particle);
  const int inner_begin = (-bands.offset.front() + band_group - 1) / band_group * band_group;
  const int inner_end = (bands.particles - bands.offset.back()) / band_group * band_group;
  const int first = std::clamp(inner_begin, begin, end), last = std::clamp(inner_end, first, end);
  if (first == last || last % band_group != 0) return filter_edge(bands, weights, whole, begin, end, scratch);
  filter_edge(bands, weights, whole, begin, first, scratch);
  filter_groups(bands, weights, whole, first, last);
  filter_edge(bands, weights, whole, last, end, scratch);
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

void filter_slices(const FilterSlices& slices, const PlacedWeights& weights, const FilterColumns& columns, int block,
                   PartScratch& scratch) {
  const FilterColumns whole = columns_from(columns, slices.first_particle);
  const FilterSlices::Block& run = slices.block[static_cast<std::size_t>(block)];
  AlignedVector<double>& memory = scratch.rows;
  memory.resize(4 * static_cast<std::size_t>(run.high - run.low));
  ordered_rows_of(whole.in, slices.order, run.low, run.high, memory.data());
  const double* rows = memory.data() - 4 * std::ptrdiff_t{run.low};
  for (int t = run.first_slice; t < run.last_slice; ++t) {
    const int* column = slices.column.data() + 4 * std::ptrdiff_t{slices.slice_begin[static_cast<std::size_t>(t)]};
    const int* end = slices.column.data() + 4 * std::ptrdiff_t{slices.slice_begin[static_cast<std::size_t>(t) + 1]};
    SliceSums sums;
    filter_slice(weights.value.data() + slices.begin + (column - slices.column.data()), column, end, rows, sums);
    if (4 * t + 4 <= slices.particles && slices.order.empty()) {
      store_slice(sums, whole.out[0] + 4 * t, whole.out[1] + 4 * t, whole.out[2] + 4 * t);
      continue;
    }
    double value[3][4];
    store_slice(sums, value[0], value[1], value[2]);
    for (int k = 0; k < 4 && 4 * t + k < slices.particles; ++k) {
      const int i = slices.order.empty() ? 4 * t + k : slices.order[static_cast<std::size_t>(4 * t + k)];
      for (int axis = 0; axis < 3; ++axis) whole.out[axis][i] = value[axis][k];
    }
  }
}

void put_filtered_columns(const FilterColumns& columns, int begin, int end) {
  const hn::ScalableTag<double> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  int i = begin;
  for (; i + lanes <= end; i += lanes)
    for (int axis = 0; axis < 3; ++axis) {
      hn::Vec<decltype(d)> filtered[] = {hn::LoadU(d, columns.out[axis] + i)};
      put(d, columns, axis, i, filtered);
    }
  for (; i < end; ++i)
    for (int axis = 0; axis < 3; ++axis) columns.put(axis, i, columns.out[axis][i]);
}

}  // namespace billow::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace billow::sim {

HWY_EXPORT(filter_bands);
HWY_EXPORT(filter_slices);
HWY_EXPORT(put_filtered_columns);

void filter_bands(const FilterBands& bands, const PlacedWeights& weights, const FilterColumns& columns, int begin,
                  int end, PartScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(filter_bands)(bands, weights, columns, begin, end, scratch);
}

void filter_slices(const FilterSlices& slices, const PlacedWeights& weights, const FilterColumns& columns, int block,
                   PartScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(filter_slices)(slices, weights, columns, block, scratch);
}

void put_filtered(const FilterColumns& columns, int begin, int end) {
  HWY_DYNAMIC_DISPATCH(put_filtered_columns)(columns, begin, end);
}

}  // namespace billow::sim
#endif
