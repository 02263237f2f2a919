// The spring pass over slices, compiled once for each instruction set. In an order that does not depend on the lanes:
// all sets give the same bits.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sim/spring_pass.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/slice_pass.cpp"
#include <hwy/foreach_target.h>
// After foreach_target: it includes the rest of this file again for each instruction set.
#include <hwy/highway.h>

#include "sim/spring_arithmetic-inl.h"

HWY_BEFORE_NAMESPACE();
namespace billow::sim::HWY_NAMESPACE {
namespace {

/// Room that a thread keeps from pass to pass.
struct Scratch {
  AlignedVector<double> ring, position, velocity;
};

Scratch& scratch() {
  static thread_local Scratch memory;
  return memory;
}

/// A block's particles, row by row, and the forces of its last springs.
struct SliceRows {
  const double *position, *velocity;  // entry 4 i is particle i's x
  double* ring;                       // 4 doubles a spring
};

// The sums of a slice's particles to where they belong, one by one.
inline void put_one_by_one(const SpringSlices& slices, int slice, const double sum[3][4], const SpringSink& sink) {
  for (int k = 0; k < 4 && 4 * slice + k < slices.particles; ++k) {
    const std::size_t row = static_cast<std::size_t>(4 * slice + k);
    const int i = slices.order.empty() ? 4 * slice + k : slices.order[row];
    for (int axis = 0; axis < 3; ++axis) sink.put(axis, i, sum[axis][k]);
  }
}

#if HWY_MAX_BYTES >= 32

/// One value of four in all lanes.
template <int lane>
HWY_INLINE QV broadcast(QV v) {
  const Quad d;
  const QV half = lane < 2 ? hn::ConcatLowerLower(d, v, v) : hn::ConcatUpperUpper(d, v, v);
  return lane % 2 == 0 ? hn::DupEven(half) : hn::DupOdd(half);
}

// The forces of four springs into the ring.
template <SpringDamping damping>
HWY_INLINE void quad_forces(const SpringSlices& slices, const SliceRows& rows, int quad) {
  const Quad d;
  const std::ptrdiff_t at = 4 * std::ptrdiff_t{quad};
  const int *first = slices.first.data() + at, *second = slices.second.data() + at;
  const auto between = [&](const double* row, int k) HWY_ATTR {
    return hn::Sub(hn::Load(d, row + 4 * std::ptrdiff_t{second[k]}), hn::Load(d, row + 4 * std::ptrdiff_t{first[k]}));
  };
  const auto quads = [&](const double* row) HWY_ATTR {
    return Rows{between(row, 0), between(row, 1), between(row, 2), between(row, 3)};
  };
  const Rows along = quads(rows.position);
  const Vector3<QV> along_axes = transposed(along);
  const QV square = dot(along_axes, along_axes);
  const QV rest_length = hn::Load(d, slices.rest_length.data() + at);
  QV scale = elastic_scale(d, square, rest_length, hn::Load(d, slices.stiffness.data() + at));
  Rows velocity;
  QV coefficient;
  if constexpr (damping != SpringDamping::none) {
    velocity = quads(rows.velocity);
    coefficient = hn::Load(d, slices.damping.data() + at);
  }
  if constexpr (damping == SpringDamping::projected)
    scale = hn::Add(scale, damping_scale(d, square, dot(along_axes, transposed(velocity)), rest_length, coefficient));
  double* out = rows.ring + (at & (slices.ring - 1)) * 4;
  Rows force{hn::Mul(broadcast<0>(scale), along.a), hn::Mul(broadcast<1>(scale), along.b),
             hn::Mul(broadcast<2>(scale), along.c), hn::Mul(broadcast<3>(scale), along.e)};
  if constexpr (damping == SpringDamping::relative)
    force = {hn::Add(force.a, hn::Mul(broadcast<0>(coefficient), velocity.a)),
             hn::Add(force.b, hn::Mul(broadcast<1>(coefficient), velocity.b)),
             hn::Add(force.c, hn::Mul(broadcast<2>(coefficient), velocity.c)),
             hn::Add(force.e, hn::Mul(broadcast<3>(coefficient), velocity.e))};
  hn::Store(force.a, d, out), hn::Store(force.b, d, out + 4);
  hn::Store(force.c, d, out + 8), hn::Store(force.e, d, out + 12);
}

// The sums of four particles, added to their places.
HWY_INLINE void sum_slice(const SpringSlices& slices, const double* ring, int slice, const SpringSink& sink) {
  const Quad d;
  const std::uint32_t* entry = slices.entry.data() + slices.entry_begin[static_cast<std::size_t>(slice)];
  const std::uint32_t* end = slices.entry.data() + slices.entry_begin[static_cast<std::size_t>(slice) + 1];
  const std::uint32_t* plus_end = entry + 4 * slices.plus[static_cast<std::size_t>(slice)];
  QV a = hn::Zero(d), b = a, c = a, e = a;
  const auto waiting = [&](int k) HWY_ATTR { return hn::Load(d, ring + entry[k]); };
  for (; entry != plus_end; entry += 4)
    a = hn::Add(a, waiting(0)), b = hn::Add(b, waiting(1)), c = hn::Add(c, waiting(2)), e = hn::Add(e, waiting(3));
  for (; entry != end; entry += 4)
    a = hn::Sub(a, waiting(0)), b = hn::Sub(b, waiting(1)), c = hn::Sub(c, waiting(2)), e = hn::Sub(e, waiting(3));
  const Vector3<QV> axes = transposed({a, b, c, e});
  const std::ptrdiff_t i = 4 * std::ptrdiff_t{slice};
  if (i + 4 <= slices.particles && slices.order.empty()) {
    put(d, sink, 0, i, axes.x), put(d, sink, 1, i, axes.y), put(d, sink, 2, i, axes.z);
    return;
  }
  HWY_ALIGN double last[3][4];
  hn::Store(axes.x, d, last[0]), hn::Store(axes.y, d, last[1]), hn::Store(axes.z, d, last[2]);
  put_one_by_one(slices, slice, last, sink);
}

#else  // two doubles to a vector: plain arithmetic is as fast, and has the same bits

template <SpringDamping damping>
void quad_forces(const SpringSlices& slices, const SliceRows& rows, int quad) {
  for (std::size_t s = 4 * static_cast<std::size_t>(quad), end = s + 4; s != end; ++s) {
    const std::ptrdiff_t i = 4 * std::ptrdiff_t{slices.first[s]}, j = 4 * std::ptrdiff_t{slices.second[s]};
    const auto between = [&](const double* row) {
      return std::array<double, 3>{row[j] - row[i], row[j + 1] - row[i + 1], row[j + 2] - row[i + 2]};
    };
    const auto product = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    const std::array<double, 3> along = between(rows.position);
    const double square = product(along, along), length = std::sqrt(square);
    double scale = length > 0.0 ? slices.stiffness[s] * (length - slices.rest_length[s]) / length : 0.0;
    std::array<double, 3> velocity = {};
    if constexpr (damping != SpringDamping::none) velocity = between(rows.velocity);
    if constexpr (damping == SpringDamping::projected)
      scale += square > 0.0 ? slices.damping[s] * product(along, velocity) / square : 0.0;
    double* out = rows.ring + static_cast<std::ptrdiff_t>(s & (static_cast<std::size_t>(slices.ring) - 1)) * 4;
    for (int axis = 0; axis < 3; ++axis) {
      out[axis] = scale * along[axis];
      if constexpr (damping == SpringDamping::relative) out[axis] += slices.damping[s] * velocity[axis];
    }
  }
}

void sum_slice(const SpringSlices& slices, const double* ring, int slice, const SpringSink& sink) {
  const std::uint32_t* entry = slices.entry.data() + slices.entry_begin[static_cast<std::size_t>(slice)];
  const std::uint32_t* end = slices.entry.data() + slices.entry_begin[static_cast<std::size_t>(slice) + 1];
  const std::uint32_t* plus_end = entry + 4 * slices.plus[static_cast<std::size_t>(slice)];
  double sum[3][4] = {};
  for (; entry != end; entry += 4)
    for (int k = 0; k < 4; ++k)
      for (int axis = 0; axis < 3; ++axis)
        sum[axis][k] += entry < plus_end ? ring[entry[k] + axis] : -ring[entry[k] + axis];
  put_one_by_one(slices, slice, sum, sink);
}

#endif

template <SpringDamping damping>
void sweep_slices(const SpringSlices& slices, const SpringColumns& whole, const SpringSink& sink,
                  const SpringSlices::Block& block) {
  Scratch& memory = scratch();
  const auto block_rows = [&](const double* const column[3], AlignedVector<double>& rows) {
    rows.resize(4 * static_cast<std::size_t>(block.high - block.low));
    ordered_rows_of(column, slices.order, block.low, block.high, rows.data());
    return rows.data() - 4 * std::ptrdiff_t{block.low};
  };
  memory.ring.resize(4 * static_cast<std::size_t>(slices.ring + 1));
  std::fill(memory.ring.end() - 4, memory.ring.end(), 0.0);
  const SliceRows rows{block_rows(whole.position, memory.position),
                       damping == SpringDamping::none ? nullptr : block_rows(whole.velocity, memory.velocity),
                       memory.ring.data()};
  int quad = block.first_quad;
  for (int slice = block.first_slice; slice < block.last_slice; ++slice) {
    const int ahead = std::min(slice + slice_lead, block.last_slice - 1);
    for (const int end = slices.slice_quads[static_cast<std::size_t>(ahead)]; quad < end; ++quad)
      quad_forces<damping>(slices, rows, quad);
    sum_slice(slices, rows.ring, slice, sink);
  }
}

}  // namespace

void sweep_springs_of_slices(const SpringSlices& slices, const SpringColumns& columns, const SpringSink& sink,
                             int block) {
  SpringColumns whole;
  for (int axis = 0; axis < 3; ++axis) {
    whole.position[axis] = columns.position[axis] + slices.first_particle;
    whole.velocity[axis] = columns.velocity[axis] + slices.first_particle;
  }
  const SpringSink own = sink.from(slices.first_particle);
  const SpringSlices::Block& run = slices.block[static_cast<std::size_t>(block)];
  if (!slices.damped)
    sweep_slices<SpringDamping::none>(slices, whole, own, run);
  else if (slices.damping_model == DampingModel::projected)
    sweep_slices<SpringDamping::projected>(slices, whole, own, run);
  else
    sweep_slices<SpringDamping::relative>(slices, whole, own, run);
}

}  // namespace billow::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace billow::sim {

HWY_EXPORT(sweep_springs_of_slices);

void sweep_springs(const SpringSlices& slices, const SpringColumns& columns, const SpringSink& sink, int block) {
  HWY_DYNAMIC_DISPATCH(sweep_springs_of_slices)(slices, columns, sink, block);
}

}  // namespace billow::sim
#endif
