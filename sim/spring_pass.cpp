// The spring passes, compiled once for each instruction set. Only additions, subtractions, multiplications, divisions
// and square roots, each rounded as IEEE 754 says and none contracted, in an order that does not depend on the lanes:
// all sets give the same bits.
#include "sim/spring_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/spring_pass.cpp"
#include <hwy/foreach_target.h>
// After foreach_target: it includes the rest of this file again for each instruction set.
#include <hwy/highway.h>

#include "sim/vector_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace billow::sim::HWY_NAMESPACE {

enum class SpringDamping { none, projected, relative };

template <class D, class V = hn::Vec<D>>
HWY_INLINE Vector3<V> load(D d, const double* const column[3], std::ptrdiff_t i) {
  return {hn::LoadU(d, column[0] + i), hn::LoadU(d, column[1] + i), hn::LoadU(d, column[2] + i)};
}

template <class V>
HWY_INLINE Vector3<V> operator-(const Vector3<V>& a, const Vector3<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

template <class V>
HWY_INLINE V dot(const Vector3<V>& a, const Vector3<V>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

// k (l - L) / l; what is not a spring (L = 0) and a spring of zero length, which has no direction, push nowhere.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V elastic_scale(D d, V square, V rest_length, V stiffness) {
  const V length = hn::Sqrt(square);
  const V scale = hn::Div(hn::Mul(stiffness, hn::Sub(length, rest_length)), length);
  return hn::IfThenElseZero(hn::Gt(hn::Min(length, rest_length), hn::Zero(d)), scale);
}

// c (d . w) / d^2: c (u . w) u along the spring, w the relative velocity.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V damping_scale(D d, V square, V along, V rest_length, V damping) {
  return hn::IfThenElseZero(hn::Gt(hn::Min(square, rest_length), hn::Zero(d)),
                            hn::Div(hn::Mul(damping, along), square));
}

/// The last forces of one stride's springs, [position % length], each axis in a row of length + band_group. The first
/// group is repeated behind the last, so that a vector read from anywhere is contiguous.
struct Ring {
  double* axis[3];
  std::ptrdiff_t length, write, read, stride;
  double stiffness, damping;
};

// A sum is taken this many particles behind the springs that are being computed, so that what was stored is in the
// cache before it is loaded at another alignment.
constexpr int lag = 16;

/// Columns over some of the particles: entry i is particle i of the body.
struct Segment {
  const double* position[3];
  const double* velocity[3];
  double* force[3];
};

template <SpringDamping damping>
class BandSweep {
 public:
  BandSweep(const SpringBands& bands, int begin, AlignedVector<double>& memory)
      : rest_length_(bands.rest_length.data()),
        begin_(begin),
        strides_(static_cast<std::ptrdiff_t>(bands.stride.size())) {
    std::vector<Ring>& ring = rings(bands, memory);
    ring_begin_ = ring.data();
    ring_end_ = ring.data() + ring.size();
  }

  // Springs of particles [from, to) and the sums of [from - lag, to - lag).
  void springs_and_sums(const Segment& segment, int from, int to) {
    const hn::ScalableTag<double> d;
    for (int i = from; i < to; i += static_cast<int>(hn::Lanes(d))) {
      start_springs(segment, i);
      if (i - lag >= begin_)
        end_springs(segment, i - lag);
      else
        advance_reads();
    }
  }

  void remaining_sums(const Segment& segment, int to) {
    const hn::ScalableTag<double> d;
    for (int i = to - lag; i < to; i += static_cast<int>(hn::Lanes(d)))
      if (i >= begin_)
        end_springs(segment, i);
      else
        advance_reads();
  }

 private:
  using D = hn::ScalableTag<double>;
  using V = hn::Vec<D>;

  static std::vector<Ring>& rings(const SpringBands& bands, AlignedVector<double>& memory) {
    static thread_local std::vector<Ring> ring;
    ring.resize(bands.stride.size());
    std::size_t size = 0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::ptrdiff_t stride = bands.stride[k];
      ring[k].length = (stride + lag + 2 * band_group - 1) / band_group * band_group;
      ring[k].stride = stride;
      ring[k].stiffness = bands.stiffness[k];
      ring[k].damping = bands.damping[k];
      ring[k].write = 0;
      ring[k].read = ring[k].length - lag - stride;
      size += 3 * static_cast<std::size_t>(ring[k].length + band_group);
    }
    memory.assign(size, 0.0);
    double* free = memory.data();
    for (Ring& r : ring)
      for (double*& axis : r.axis) axis = free, free += r.length + band_group;
    return ring;
  }

  HWY_INLINE void start_springs(const Segment& segment, int i) {
    const D d;
    const std::ptrdiff_t lanes = static_cast<std::ptrdiff_t>(hn::Lanes(d));
    const double* rest =
        rest_length_ + static_cast<std::ptrdiff_t>(i / band_group) * strides_ * band_group + i % band_group;
    const double* const position[3] = {segment.position[0], segment.position[1], segment.position[2]};
    const Vector3<V> own_position = load(d, position, i);
    Vector3<V> own_velocity;
    if constexpr (damping != SpringDamping::none) own_velocity = load(d, segment.velocity, i);
    V sum_x = hn::Zero(d), sum_y = sum_x, sum_z = sum_x;
    for (Ring *ring = ring_begin_, *const end = ring_end_; ring != end; ++ring, rest += band_group) {
      const Vector3<V> along = load(d, position, i + ring->stride) - own_position;
      const V square = dot(along, along), rest_length = hn::Load(d, rest);
      V scale = elastic_scale(d, square, rest_length, hn::Set(d, ring->stiffness));
      Vector3<V> relative;
      if constexpr (damping != SpringDamping::none)
        relative = load(d, segment.velocity, i + ring->stride) - own_velocity;
      const V coefficient = hn::Set(d, ring->damping);
      if constexpr (damping == SpringDamping::projected)
        scale = hn::Add(scale, damping_scale(d, square, dot(along, relative), rest_length, coefficient));
      Vector3<V> force{hn::Mul(scale, along.x), hn::Mul(scale, along.y), hn::Mul(scale, along.z)};
      if constexpr (damping == SpringDamping::relative) {
        const V c = hn::IfThenElseZero(hn::Gt(rest_length, hn::Zero(d)), coefficient);
        force = {hn::Add(force.x, hn::Mul(c, relative.x)), hn::Add(force.y, hn::Mul(c, relative.y)),
                 hn::Add(force.z, hn::Mul(c, relative.z))};
      }
      store(ring, force, lanes);
      sum_x = hn::Add(sum_x, force.x), sum_y = hn::Add(sum_y, force.y), sum_z = hn::Add(sum_z, force.z);
    }
    if (i < begin_) return;
    add_to(segment.force[0] + i, sum_x), add_to(segment.force[1] + i, sum_y), add_to(segment.force[2] + i, sum_z);
  }

  HWY_INLINE void store(Ring* ring, const Vector3<V>& force, std::ptrdiff_t lanes) {
    const D d;
    const std::ptrdiff_t at = ring->write;
    hn::StoreU(force.x, d, ring->axis[0] + at);
    hn::StoreU(force.y, d, ring->axis[1] + at);
    hn::StoreU(force.z, d, ring->axis[2] + at);
    if (HWY_UNLIKELY(at < band_group)) {
      hn::StoreU(force.x, d, ring->axis[0] + ring->length + at);
      hn::StoreU(force.y, d, ring->axis[1] + ring->length + at);
      hn::StoreU(force.z, d, ring->axis[2] + ring->length + at);
    }
    ring->write = at + lanes == ring->length ? 0 : at + lanes;
  }

  HWY_INLINE void end_springs(const Segment& segment, int i) {
    const D d;
    const std::ptrdiff_t lanes = static_cast<std::ptrdiff_t>(hn::Lanes(d));
    V sum_x = hn::Zero(d), sum_y = sum_x, sum_z = sum_x;
    for (Ring *ring = ring_begin_, *const end = ring_end_; ring != end; ++ring) {
      sum_x = hn::Sub(sum_x, hn::LoadU(d, ring->axis[0] + ring->read));
      sum_y = hn::Sub(sum_y, hn::LoadU(d, ring->axis[1] + ring->read));
      sum_z = hn::Sub(sum_z, hn::LoadU(d, ring->axis[2] + ring->read));
      advance(ring, lanes);
    }
    add_to(segment.force[0] + i, sum_x), add_to(segment.force[1] + i, sum_y), add_to(segment.force[2] + i, sum_z);
  }

  HWY_INLINE static void advance(Ring* ring, std::ptrdiff_t lanes) {
    const std::ptrdiff_t next = ring->read + lanes;
    ring->read = next >= ring->length ? next - ring->length : next;
  }

  HWY_INLINE void advance_reads() {
    for (Ring* ring = ring_begin_; ring != ring_end_; ++ring)
      advance(ring, static_cast<std::ptrdiff_t>(hn::Lanes(D())));
  }

  HWY_INLINE static void add_to(double* sum, V value) {
    const D d;
    hn::StoreU(hn::Add(hn::LoadU(d, sum), value), d, sum);
  }

  const double* rest_length_;
  const int begin_;
  const std::ptrdiff_t strides_;
  Ring *ring_begin_, *ring_end_;
};

/// Room that a thread keeps from pass to pass.
struct Scratch {
  AlignedVector<double> ring, position, velocity, force;
};

Scratch& scratch() {
  static thread_local Scratch memory;
  return memory;
}

/// The last particles of a body, [begin, end), copied with zeros behind them, so that vectors may read and write
/// beyond.
class Tail {
 public:
  Tail(const SpringBands& bands, const Segment& whole, int begin, int own_begin, int end, bool with_velocity)
      : begin_(begin),
        force_begin_(begin - lag),
        first_(std::max(force_begin_, own_begin)),
        end_(end),
        rows_(padded(bands, begin)) {
    copy_in(whole.position, bands.particles, scratch().position, segment_.position);
    if (with_velocity) copy_in(whole.velocity, bands.particles, scratch().velocity, segment_.velocity);
    AlignedVector<double>& force = scratch().force;
    force.assign(3 * static_cast<std::size_t>(rows_ + lag), 0.0);
    for (int axis = 0; axis < 3; ++axis) {
      double* column = force.data() + axis * (rows_ + lag);
      std::copy(whole.force[axis] + first_, whole.force[axis] + end_, column + (first_ - force_begin_));
      segment_.force[axis] = column - force_begin_;
    }
  }

  const Segment& segment() const { return segment_; }

  void copy_out(const Segment& whole) const {
    for (int axis = 0; axis < 3; ++axis)
      std::copy(segment_.force[axis] + first_, segment_.force[axis] + end_, whole.force[axis] + first_);
  }

 private:
  static int padded(const SpringBands& bands, int begin) {
    return bands.particles - begin + 2 * band_group + bands.stride.back();
  }

  void copy_in(const double* const whole[3], int particles, AlignedVector<double>& memory, const double* columns[3]) {
    memory.assign(3 * static_cast<std::size_t>(rows_), 0.0);
    for (int axis = 0; axis < 3; ++axis) {
      double* column = memory.data() + axis * rows_;
      std::copy(whole[axis] + begin_, whole[axis] + particles, column);
      columns[axis] = column - begin_;
    }
  }

  int begin_, force_begin_, first_, end_, rows_;
  Segment segment_{};
};

int rounded_down(int value) { return value / band_group * band_group; }

template <SpringDamping damping>
void sweep_bands(const SpringBands& bands, const Segment& whole, int begin, int end) {
  const int reach = bands.stride.back();
  // Up to here vectors that read a stride ahead stay within the body.
  const int safe = std::max(rounded_down(bands.particles - reach), 0);
  const int start = std::max(rounded_down(begin - reach), 0);
  const int last = (end + band_group - 1) / band_group * band_group;
  BandSweep<damping> sweep(bands, begin, scratch().ring);
  if (last <= safe) {
    sweep.springs_and_sums(whole, start, last);
    sweep.remaining_sums(whole, last);
    return;
  }
  const int middle = std::max(start, std::min(safe, last));
  sweep.springs_and_sums(whole, start, middle);
  const Tail tail(bands, whole, middle, begin, end, damping != SpringDamping::none);
  sweep.springs_and_sums(tail.segment(), middle, last);
  sweep.remaining_sums(tail.segment(), last);
  tail.copy_out(whole);
}

Segment segment_of(const SpringColumns& columns, int first_particle) {
  Segment segment;
  for (int axis = 0; axis < 3; ++axis) {
    segment.position[axis] = columns.position[axis] + first_particle;
    segment.velocity[axis] = columns.velocity[axis] + first_particle;
    segment.force[axis] = columns.force[axis] + first_particle;
  }
  return segment;
}

void add_band_forces(const SpringBands& bands, const SpringColumns& columns, int begin, int end) {
  const Segment whole = segment_of(columns, bands.first_particle);
  if (!bands.damped)
    sweep_bands<SpringDamping::none>(bands, whole, begin, end);
  else if (bands.damping_model == DampingModel::projected)
    sweep_bands<SpringDamping::projected>(bands, whole, begin, end);
  else
    sweep_bands<SpringDamping::relative>(bands, whole, begin, end);
}

// ---- slices ----

/// A block's particles, row by row, and the forces of its last springs.
struct SliceRows {
  const double *position, *velocity;  // entry 4 i is particle i's x
  double* ring;                       // 4 doubles a spring
};

// The sums of a slice's particles to where they belong, one by one.
inline void add_one_by_one(const SpringSlices& slices, int slice, const double sum[3][4], double* const force[3]) {
  for (int k = 0; k < 4 && 4 * slice + k < slices.particles; ++k) {
    const std::size_t row = static_cast<std::size_t>(4 * slice + k);
    const int i = slices.order.empty() ? 4 * slice + k : slices.order[row];
    for (int axis = 0; axis < 3; ++axis) force[axis][i] += sum[axis][k];
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
HWY_INLINE void sum_slice(const SpringSlices& slices, const double* ring, int slice, double* const force[3]) {
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
    hn::StoreU(hn::Add(hn::LoadU(d, force[0] + i), axes.x), d, force[0] + i);
    hn::StoreU(hn::Add(hn::LoadU(d, force[1] + i), axes.y), d, force[1] + i);
    hn::StoreU(hn::Add(hn::LoadU(d, force[2] + i), axes.z), d, force[2] + i);
    return;
  }
  HWY_ALIGN double last[3][4];
  hn::Store(axes.x, d, last[0]), hn::Store(axes.y, d, last[1]), hn::Store(axes.z, d, last[2]);
  add_one_by_one(slices, slice, last, force);
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

void sum_slice(const SpringSlices& slices, const double* ring, int slice, double* const force[3]) {
  const std::uint32_t* entry = slices.entry.data() + slices.entry_begin[static_cast<std::size_t>(slice)];
  const std::uint32_t* end = slices.entry.data() + slices.entry_begin[static_cast<std::size_t>(slice) + 1];
  const std::uint32_t* plus_end = entry + 4 * slices.plus[static_cast<std::size_t>(slice)];
  double sum[3][4] = {};
  for (; entry != end; entry += 4)
    for (int k = 0; k < 4; ++k)
      for (int axis = 0; axis < 3; ++axis)
        sum[axis][k] += entry < plus_end ? ring[entry[k] + axis] : -ring[entry[k] + axis];
  add_one_by_one(slices, slice, sum, force);
}

#endif

template <SpringDamping damping>
void sweep_slices(const SpringSlices& slices, const Segment& whole, const SpringSlices::Block& block) {
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
    sum_slice(slices, rows.ring, slice, whole.force);
  }
}

void add_slice_forces(const SpringSlices& slices, const SpringColumns& columns, int block) {
  const Segment whole = segment_of(columns, slices.first_particle);
  const SpringSlices::Block& run = slices.block[static_cast<std::size_t>(block)];
  if (!slices.damped)
    sweep_slices<SpringDamping::none>(slices, whole, run);
  else if (slices.damping_model == DampingModel::projected)
    sweep_slices<SpringDamping::projected>(slices, whole, run);
  else
    sweep_slices<SpringDamping::relative>(slices, whole, run);
}

}  // namespace billow::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace billow::sim {

HWY_EXPORT(add_band_forces);
HWY_EXPORT(add_slice_forces);

void add_band_forces(const SpringBands& bands, const SpringColumns& columns, int begin, int end) {
  HWY_DYNAMIC_DISPATCH(add_band_forces)(bands, columns, begin, end);
}

void add_slice_forces(const SpringSlices& slices, const SpringColumns& columns, int block) {
  HWY_DYNAMIC_DISPATCH(add_slice_forces)(slices, columns, block);
}

}  // namespace billow::sim
#endif
