// The spring pass over bands, compiled once for each instruction set. In an order that does not depend on the lanes:
// all sets give the same bits.
#include <algorithm>
#include <cstddef>
#include <vector>

#include "sim/pass/spring_pass.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/pass/band_pass.cpp"
#include <hwy/foreach_target.h>
// After foreach_target: it includes the rest of this file again for each instruction set.
#include <hwy/highway.h>

#include "sim/pass/spring_arithmetic-inl.h"

HWY_BEFORE_NAMESPACE();
namespace billow::sim::HWY_NAMESPACE {
namespace {

// A sum is taken this many particles behind the springs that are being computed, so that what was stored is in the
// cache before it is loaded at another alignment.
constexpr int lag = band_group;

/// One sweep over the particles [begin, end) of a body, and over those before them whose springs reach them.
template <SpringDamping damping>
class BandSweep {
 public:
  BandSweep(const SpringBands& bands, const SpringSink& sink, int begin, int end, PartScratch& scratch)
      : rest_length_(bands.rest_length.data()), group_(bands.group.data()), sink_(sink), begin_(begin), end_(end) {
    lay_rings(bands, scratch);
    ring_begin_ = scratch.rings.data();
    ring_end_ = ring_begin_ + bands.stride.size();
    waiting_ = scratch.ring.data();
  }

  // Springs of particles [from, to) and the sums of [from - lag, to - lag).
  void springs_and_sums(const SpringColumns& segment, int from, int to) {
    if (from >= to) return;
    Vector3<V> own = load(D(), segment.position, from);
    Started springs = start(segment, own, from + ring_begin_->stride);
    for (int i = from; i < to; i += lanes) {
      start_springs(segment, i, std::min(i + lanes, to - lanes), own, springs);
      end_springs(i - lag);
    }
  }

  void remaining_sums(int to) {
    for (int i = to - lag; i < to; i += lanes) end_springs(i);
  }

 private:
  using D = hn::ScalableTag<double>;
  using V = hn::Vec<D>;
  static constexpr int lanes = static_cast<int>(hn::MaxLanes(D()));
  static_assert(band_group % lanes == 0);

  static void lay_rings(const SpringBands& bands, PartScratch& memory) {
    memory.rings.resize(bands.stride.size());
    std::size_t size = 3 * 2 * lag;
    for (std::size_t k = 0; k < bands.stride.size(); ++k) {
      BandRing& ring = memory.rings[k];
      ring.stride = bands.stride[k];
      ring.length = (ring.stride + lag + 2 * lanes - 1) / lanes * lanes;
      ring.stiffness = bands.stiffness[k];
      ring.damping = bands.damping[k];
      ring.write = 0;
      ring.read = ring.length - lag - ring.stride;
      size += 3 * static_cast<std::size_t>(ring.length + lanes);
    }
    memory.ring.assign(size, 0.0);
    double* free = memory.ring.data() + 3 * 2 * lag;
    for (BandRing& ring : memory.rings)
      for (double*& row : ring.row) row = free, free += ring.length + lanes;
  }

  // The sums of the springs that start in a particle wait here until those that end there are known.
  HWY_INLINE double* waiting(int i) const { return waiting_ + (i & (2 * lag - 1)); }

  /// Springs whose lengths have been asked for.
  struct Started {
    Vector3<V> along;
    V square, length;
  };

  HWY_INLINE static Started start(const SpringColumns& segment, const Vector3<V>& own, std::ptrdiff_t other) {
    Started springs;
    springs.along = load(D(), segment.position, other) - own;
    springs.square = dot(springs.along, springs.along);
    springs.length = hn::Sqrt(springs.square);
    return springs;
  }

  // The springs that start in the particles from i on, of which the first stride's are started already. Each stride's
  // lengths are asked for before the forces of the one before it are, the first one's of the particles from `behind` on
  // last: square roots take long, and what waits for them would keep the processor from looking farther ahead.
  HWY_INLINE void start_springs(const SpringColumns& segment, int i, int behind, Vector3<V>& own, Started& springs) {
    const D d;
    const double* rest = rest_length_ + group_[i / band_group].begin + i % band_group;
    Vector3<V> own_velocity;
    if constexpr (damping != SpringDamping::none) own_velocity = load(d, segment.velocity, i);
    Vector3<V> sum{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    BandRing* ring = ring_begin_;
    for (BandRing* const last = ring_end_ - 1; ring != last; ++ring, rest += band_group) {
      const Started next = start(segment, own, i + (ring + 1)->stride);
      finish(segment, i, own_velocity, springs, ring, rest, sum);
      springs = next;
    }
    own = load(d, segment.position, behind);
    const Started next = start(segment, own, behind + ring_begin_->stride);
    finish(segment, i, own_velocity, springs, ring, rest, sum);
    springs = next;
    double* const wait = waiting(i);
    hn::Store(sum.x, d, wait), hn::Store(sum.y, d, wait + 2 * lag), hn::Store(sum.z, d, wait + 4 * lag);
  }

  HWY_INLINE void finish(const SpringColumns& segment, int i, const Vector3<V>& own_velocity, const Started& springs,
                         BandRing* ring, const double* rest, Vector3<V>& sum) {
    const D d;
    const Vector3<V>& along = springs.along;
    const V rest_length = hn::Load(d, rest);
    V scale = elastic_scale(d, springs.length, rest_length, hn::Set(d, ring->stiffness));
    Vector3<V> relative;
    if constexpr (damping != SpringDamping::none) relative = load(d, segment.velocity, i + ring->stride) - own_velocity;
    const V coefficient = hn::Set(d, ring->damping);
    if constexpr (damping == SpringDamping::projected)
      scale = hn::Add(scale, damping_scale(d, springs.square, dot(along, relative), rest_length, coefficient));
    Vector3<V> force{hn::Mul(scale, along.x), hn::Mul(scale, along.y), hn::Mul(scale, along.z)};
    if constexpr (damping == SpringDamping::relative) {
      const V c = hn::IfThenElseZero(hn::Gt(rest_length, hn::Zero(d)), coefficient);
      force = {hn::Add(force.x, hn::Mul(c, relative.x)), hn::Add(force.y, hn::Mul(c, relative.y)),
               hn::Add(force.z, hn::Mul(c, relative.z))};
    }
    store(ring, force);
    sum = {hn::Add(sum.x, force.x), hn::Add(sum.y, force.y), hn::Add(sum.z, force.z)};
  }

  HWY_INLINE static void store(BandRing* ring, const Vector3<V>& force) {
    const D d;
    const std::ptrdiff_t at = ring->write;
    hn::Store(force.x, d, ring->row[0] + at);
    hn::Store(force.y, d, ring->row[1] + at);
    hn::Store(force.z, d, ring->row[2] + at);
    if (HWY_UNLIKELY(at == 0)) {
      hn::Store(force.x, d, ring->row[0] + ring->length);
      hn::Store(force.y, d, ring->row[1] + ring->length);
      hn::Store(force.z, d, ring->row[2] + ring->length);
    }
    ring->write = at + lanes == ring->length ? 0 : at + lanes;
  }

  HWY_INLINE void end_springs(int i) {
    const D d;
    const double* const wait = waiting(i);
    Vector3<V> sum{hn::Load(d, wait), hn::Load(d, wait + 2 * lag), hn::Load(d, wait + 4 * lag)};
    for (BandRing *ring = ring_begin_, *const end = ring_end_; ring != end; ++ring) {
      const std::ptrdiff_t read = ring->read, next = read + lanes;
      sum.x = hn::Sub(sum.x, hn::LoadU(d, ring->row[0] + read));
      sum.y = hn::Sub(sum.y, hn::LoadU(d, ring->row[1] + read));
      sum.z = hn::Sub(sum.z, hn::LoadU(d, ring->row[2] + read));
      ring->read = next >= ring->length ? next - ring->length : next;
    }
    if (i < begin_) return;
    if (HWY_UNLIKELY(i + lanes > end_)) return put_last(i, sum);
    put(d, sink_, i, sum);
  }

  // The body ends within this vector.
  void put_last(int i, const Vector3<V>& sum) {
    const D d;
    HWY_ALIGN double value[3][lanes];
    hn::Store(sum.x, d, value[0]), hn::Store(sum.y, d, value[1]), hn::Store(sum.z, d, value[2]);
    for (int k = 0; i + k < end_; ++k)
      for (int axis = 0; axis < 3; ++axis) sink_.put(axis, i + k, value[axis][k]);
  }

  const double* rest_length_;
  const BandGroup* group_;
  const SpringSink sink_;
  const int begin_, end_;
  BandRing *ring_begin_, *ring_end_;
  double* waiting_;
};

/// The last particles of a body, from `begin` on, copied with zeros behind them, so that vectors may read beyond.
class Tail {
 public:
  Tail(const SpringBands& bands, const SpringColumns& whole, int begin, bool with_velocity, PartScratch& scratch)
      : begin_(begin), rows_(bands.particles - begin + 2 * band_group + bands.stride.back()) {
    copy(whole.position, bands.particles, scratch.position, segment_.position);
    if (with_velocity) copy(whole.velocity, bands.particles, scratch.velocity, segment_.velocity);
  }

  const SpringColumns& segment() const { return segment_; }

 private:
  void copy(const double* const whole[3], int particles, AlignedVector<double>& memory, const double* columns[3]) {
    memory.assign(3 * static_cast<std::size_t>(rows_), 0.0);
    for (int axis = 0; axis < 3; ++axis) {
      double* column = memory.data() + axis * rows_;
      std::copy(whole[axis] + begin_, whole[axis] + particles, column);
      columns[axis] = column - begin_;
    }
  }

  int begin_, rows_;
  SpringColumns segment_{};
};

int rounded_down(int value) { return value / band_group * band_group; }

template <SpringDamping damping>
void sweep_bands(const SpringBands& bands, const SpringColumns& whole, const SpringSink& sink, int begin, int end,
                 PartScratch& scratch) {
  const int reach = bands.stride.back();
  // Up to here vectors that read a stride ahead stay within the body.
  const int safe = std::max(rounded_down(bands.particles - reach), 0);
  const int start = std::max(rounded_down(begin - reach), 0);
  const int last = (end + band_group - 1) / band_group * band_group;
  BandSweep<damping> sweep(bands, sink, begin, end, scratch);
  const int middle = std::max(start, std::min(safe, last));
  sweep.springs_and_sums(whole, start, middle);
  if (middle < last) {
    const Tail tail(bands, whole, middle, damping != SpringDamping::none, scratch);
    sweep.springs_and_sums(tail.segment(), middle, last);
  }
  sweep.remaining_sums(last);
}

}  // namespace

void sweep_springs_of_bands(const SpringBands& bands, const SpringColumns& columns, const SpringSink& sink, int begin,
                            int end, PartScratch& scratch) {
  SpringColumns whole;
  for (int axis = 0; axis < 3; ++axis) {
    whole.position[axis] = columns.position[axis] + bands.first_particle;
    whole.velocity[axis] = columns.velocity[axis] + bands.first_particle;
  }
  const SpringSink own = sink.from(bands.first_particle);
  if (!bands.damped)
    sweep_bands<SpringDamping::none>(bands, whole, own, begin, end, scratch);
  else if (bands.damping_model == DampingModel::projected)
    sweep_bands<SpringDamping::projected>(bands, whole, own, begin, end, scratch);
  else
    sweep_bands<SpringDamping::relative>(bands, whole, own, begin, end, scratch);
}

}  // namespace billow::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace billow::sim {

HWY_EXPORT(sweep_springs_of_bands);

void sweep_springs(const SpringBands& bands, const SpringColumns& columns, const SpringSink& sink, int begin, int end,
                   PartScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(sweep_springs_of_bands)(bands, columns, sink, begin, end, scratch);
}

}  // namespace billow::sim
#endif
