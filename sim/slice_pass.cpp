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

/// The particles around the slice that a sweep has come to. A particle's position, sum and velocity, each x, y, z, 0,
/// lie side by side: in arrays of their own, a whole number of pages apart, loads of the one would wait for stores to
/// the other.
template <SpringDamping damping>
struct SliceRing {
  static constexpr std::size_t row = slice_row(damping != SpringDamping::none);
  double* rows;

  double* position(std::size_t offset) const { return rows + offset; }
  double* sum(std::size_t offset) const { return rows + offset + 4; }
  double* velocity(std::size_t offset) const { return rows + offset + 8; }
};

/// The quads of one slice.
struct Quads {
  const std::uint32_t *other, *end;
  const double *rest_length, *stiffness, *damping;
};

Quads quads_of(const SpringSlices& slices, int slice) {
  const std::ptrdiff_t begin = slice_lanes * std::ptrdiff_t{slices.begin[static_cast<std::size_t>(slice)]},
                       end = slice_lanes * std::ptrdiff_t{slices.begin[static_cast<std::size_t>(slice) + 1]};
  return {slices.other.data() + begin, slices.other.data() + end, slices.rest_length.data() + begin,
          slices.stiffness.data() + begin, slices.damping.data() + begin};
}

#if HWY_MAX_BYTES >= 32

/// Where four particles' positions, sums or velocities are.
struct Four {
  double *a, *b, *c, *e;
};

HWY_INLINE Rows load_rows(const Four& at) {
  const Quad d;
  return {hn::Load(d, at.a), hn::Load(d, at.b), hn::Load(d, at.c), hn::Load(d, at.e)};
}

// One after another: the four may be the same particle.
HWY_INLINE void subtract(const Rows& rows, const Four& from) {
  const Quad d;
  hn::Store(hn::Sub(hn::Load(d, from.a), rows.a), d, from.a);
  hn::Store(hn::Sub(hn::Load(d, from.b), rows.b), d, from.b);
  hn::Store(hn::Sub(hn::Load(d, from.c), rows.c), d, from.c);
  hn::Store(hn::Sub(hn::Load(d, from.e), rows.e), d, from.e);
}

HWY_INLINE void add(const Rows& rows, const Four& to) {
  const Quad d;
  hn::Store(hn::Add(hn::Load(d, to.a), rows.a), d, to.a);
  hn::Store(hn::Add(hn::Load(d, to.b), rows.b), d, to.b);
  hn::Store(hn::Add(hn::Load(d, to.c), rows.c), d, to.c);
  hn::Store(hn::Add(hn::Load(d, to.e), rows.e), d, to.e);
}

HWY_INLINE Four four_rows(double* at, std::size_t a, std::size_t b, std::size_t c, std::size_t e) {
  return {at + a, at + b, at + c, at + e};
}

// The forces of a slice's springs: off their other ends, and their sums onto the slice's own particles.
template <SpringDamping damping>
HWY_INLINE void slice_forces(const Quads& quads, const SliceRing<damping>& ring, std::size_t own) {
  const Quad d;
  constexpr std::size_t row = SliceRing<damping>::row;
  const Vector3<QV> own_position = transposed(load_rows(four_rows(ring.position(own), 0, row, 2 * row, 3 * row)));
  Vector3<QV> own_velocity;
  if constexpr (damping != SpringDamping::none)
    own_velocity = transposed(load_rows(four_rows(ring.velocity(own), 0, row, 2 * row, 3 * row)));
  Vector3<QV> sum{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  std::ptrdiff_t s = 0;
  for (const std::uint32_t* other = quads.other; other != quads.end; other += slice_lanes, s += slice_lanes) {
    const auto at = [&](double* rows) HWY_ATTR { return four_rows(rows, other[0], other[1], other[2], other[3]); };
    const Vector3<QV> along = transposed(load_rows(at(ring.position(0)))) - own_position;
    const QV square = dot(along, along), rest_length = hn::Load(d, quads.rest_length + s);
    QV scale = elastic_scale(d, square, rest_length, hn::Load(d, quads.stiffness + s));
    Vector3<QV> relative;
    if constexpr (damping != SpringDamping::none) relative = transposed(load_rows(at(ring.velocity(0)))) - own_velocity;
    if constexpr (damping == SpringDamping::projected)
      scale =
          hn::Add(scale, damping_scale(d, square, dot(along, relative), rest_length, hn::Load(d, quads.damping + s)));
    Vector3<QV> force{hn::Mul(scale, along.x), hn::Mul(scale, along.y), hn::Mul(scale, along.z)};
    if constexpr (damping == SpringDamping::relative) {
      const QV c = hn::Load(d, quads.damping + s);
      force = {hn::Add(force.x, hn::Mul(c, relative.x)), hn::Add(force.y, hn::Mul(c, relative.y)),
               hn::Add(force.z, hn::Mul(c, relative.z))};
    }
    sum = {hn::Add(sum.x, force.x), hn::Add(sum.y, force.y), hn::Add(sum.z, force.z)};
    subtract(rows_from(force), at(ring.sum(0)));
  }
  add(rows_from(sum), four_rows(ring.sum(own), 0, row, 2 * row, 3 * row));
}

#else  // two doubles to a vector: plain arithmetic is as fast, and has the same bits

using Plain = std::array<double, 3>;

inline Plain difference(const double* a, const double* b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Plain& a, const Plain& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

template <SpringDamping damping>
void slice_forces(const Quads& quads, const SliceRing<damping>& ring, std::size_t own) {
  double sum[slice_lanes][3] = {};
  std::size_t s = 0;
  for (const std::uint32_t* other = quads.other; other != quads.end; ++other, ++s) {
    const std::size_t lane = s % slice_lanes, i = own + SliceRing<damping>::row * lane, j = *other;
    const double rest_length = quads.rest_length[s];
    const Plain along = difference(ring.position(j), ring.position(i));
    const double square = dot(along, along), length = std::sqrt(square);
    double scale = std::min(length, rest_length) > 0.0 ? quads.stiffness[s] * (length - rest_length) / length : 0.0;
    Plain relative = {};
    if constexpr (damping != SpringDamping::none) relative = difference(ring.velocity(j), ring.velocity(i));
    if constexpr (damping == SpringDamping::projected)
      scale += std::min(square, rest_length) > 0.0 ? quads.damping[s] * dot(along, relative) / square : 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double force = scale * along[axis];
      if constexpr (damping == SpringDamping::relative) force += quads.damping[s] * relative[axis];
      sum[lane][axis] += force;
      ring.sum(j)[axis] -= force;
    }
  }
  for (std::size_t lane = 0; lane < slice_lanes; ++lane)
    for (std::size_t axis = 0; axis < 3; ++axis)
      ring.sum(own + SliceRing<damping>::row * lane)[axis] += sum[lane][axis];
}

#endif

/// One sweep over slices [begin, end), and over those around them whose springs reach them.
template <SpringDamping damping>
class SliceSweep {
 public:
  SliceSweep(const SpringSlices& slices, const SpringColumns& columns, double* const out[3])
      : slices_(slices), columns_(columns), out_(out) {
    static thread_local AlignedVector<double> memory;  // kept from pass to pass
    memory.resize(SliceRing<damping>::row * static_cast<std::size_t>(slices.ring));
    ring_.rows = memory.data();
  }

  void run(int begin, int end) {
    const int first = std::max(begin - slices_.reach, 0), last = std::min(end + slices_.reach, slices_.slices);
    int loaded = std::max(first - slices_.reach, 0), done = begin;
    for (int slice = first; slice < last; ++slice) {
      for (const int needed = std::min(slice + slices_.reach + 1, slices_.slices); loaded < needed; ++loaded)
        load(loaded);
      slice_forces<damping>(quads_of(slices_, slice), ring_, row(slice));
      if (slice - slices_.reach >= done) finish(done++);
    }
    while (done < end) finish(done++);
  }

 private:
  std::size_t row(int slice) const {
    return SliceRing<damping>::row * static_cast<std::size_t>((slice_lanes * slice) & (slices_.ring - 1));
  }

  void load(int slice) {
    const int begin = slice_lanes * slice, end = std::min(begin + slice_lanes, slices_.particles);
    std::size_t r = row(slice);
    for (int p = begin; p < end; ++p, r += SliceRing<damping>::row) {
      const int i = slices_.order[static_cast<std::size_t>(p)];
      const auto copy = [i](const double* const column[3], double* to) {
        to[0] = column[0][i], to[1] = column[1][i], to[2] = column[2][i], to[3] = 0.0;
      };
      copy(columns_.position, ring_.position(r));
      std::fill_n(ring_.sum(r), 4, 0.0);
      if constexpr (damping != SpringDamping::none) copy(columns_.velocity, ring_.velocity(r));
    }
  }

  void finish(int slice) {
    const int begin = slice_lanes * slice, end = std::min(begin + slice_lanes, slices_.particles);
    std::size_t r = row(slice);
    for (int p = begin; p < end; ++p, r += SliceRing<damping>::row) {
      const int i = slices_.order[static_cast<std::size_t>(p)];
      const double* const sum = ring_.sum(r);
      out_[0][i] += sum[0], out_[1][i] += sum[1], out_[2][i] += sum[2];
    }
  }

  const SpringSlices& slices_;
  const SpringColumns& columns_;
  double* const* const out_;
  SliceRing<damping> ring_;
};

}  // namespace

void add_springs_of_slices(const SpringSlices& slices, const SpringColumns& columns, double* const sum[3], int begin,
                           int end) {
  SpringColumns whole;
  double* out[3];
  for (int axis = 0; axis < 3; ++axis) {
    whole.position[axis] = columns.position[axis] + slices.first_particle;
    whole.velocity[axis] = columns.velocity[axis] + slices.first_particle;
    out[axis] = sum[axis] + slices.first_particle;
  }
  if (!slices.damped)
    SliceSweep<SpringDamping::none>(slices, whole, out).run(begin, end);
  else if (slices.damping_model == DampingModel::projected)
    SliceSweep<SpringDamping::projected>(slices, whole, out).run(begin, end);
  else
    SliceSweep<SpringDamping::relative>(slices, whole, out).run(begin, end);
}

void put_sums_of_columns(const SpringSink& sink, const double* const sum[3], int begin, int end) {
  const hn::ScalableTag<double> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  int i = begin;
  for (; i + lanes <= end; i += lanes) put(d, sink, i, load(d, sum, i));
  for (; i < end; ++i)
    for (int axis = 0; axis < 3; ++axis) sink.put(axis, i, sum[axis][i]);
}

}  // namespace billow::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace billow::sim {

HWY_EXPORT(add_springs_of_slices);
HWY_EXPORT(put_sums_of_columns);

void add_springs(const SpringSlices& slices, const SpringColumns& columns, double* const sum[3], int begin, int end) {
  HWY_DYNAMIC_DISPATCH(add_springs_of_slices)(slices, columns, sum, begin, end);
}

void put_sums(const SpringSink& sink, const double* const sum[3], int begin, int end) {
  HWY_DYNAMIC_DISPATCH(put_sums_of_columns)(sink, sum, begin, end);
}

}  // namespace billow::sim
#endif
