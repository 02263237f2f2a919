// The spring pass over slices, compiled once for each instruction set. In an order that does not depend on the lanes:
// all sets give the same bits.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sim/pass/spring_pass.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/pass/slice_pass.cpp"
#include <hwy/foreach_target.h>
// After foreach_target: it includes the rest of this file again for each instruction set.
#include <hwy/highway.h>

#include "sim/pass/spring_arithmetic-inl.h"

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

/// A slice's own particles.
template <SpringDamping damping>
struct Own {
  Vector3<QV> position, velocity;
};

template <SpringDamping damping>
HWY_INLINE Own<damping> own_of(const SliceRing<damping>& ring, std::size_t at) {
  constexpr std::size_t row = SliceRing<damping>::row;
  Own<damping> own;
  own.position = transposed(load_rows(four_rows(ring.position(at), 0, row, 2 * row, 3 * row)));
  if constexpr (damping != SpringDamping::none)
    own.velocity = transposed(load_rows(four_rows(ring.velocity(at), 0, row, 2 * row, 3 * row)));
  return own;
}

/// The forces of the springs of slices, taken one after another: off the springs' other ends, and their sums onto the
/// slices' own particles. A quad's lengths are asked for before the forces of the one before it are: square roots take
/// long, and what waits for them would keep the processor from looking farther ahead.
template <SpringDamping damping>
class SliceForces {
 public:
  /// `at`: where in the ring the first slice's particles are.
  SliceForces(const SpringSlices& slices, const SliceRing<damping>& ring, int first_slice, std::size_t at)
      : slices_(slices), ring_(ring), own_(own_of(ring, at)), quad_(start(own_, place(first_slice))) {}

  /// `next`: where the particles of the slice behind it are.
  HWY_INLINE void take(int slice, std::size_t at, std::size_t next) {
    const Quad d;
    constexpr std::size_t row = SliceRing<damping>::row;
    Vector3<QV> sum{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    Own<damping> own = own_;
    Started quad = quad_;
    std::size_t k = place(slice);
    for (const std::size_t last = place(slice + 1) - slice_lanes; k != last; k += slice_lanes) {
      const Started behind = start(own, k + slice_lanes);
      finish(own, quad, k, sum);
      quad = behind;
    }
    own_ = own_of(ring_, next);
    quad_ = start(own_, k + slice_lanes);
    finish(own, quad, k, sum);
    add(rows_from(sum), four_rows(ring_.sum(at), 0, row, 2 * row, 3 * row));
  }

 private:
  /// Four springs whose lengths have been asked for.
  struct Started {
    Vector3<QV> along;
    QV square, length;
  };

  std::size_t place(int slice) const {
    return static_cast<std::size_t>(slice_lanes * std::ptrdiff_t{slices_.begin[static_cast<std::size_t>(slice)]});
  }

  HWY_INLINE Four others(double* rows, std::size_t k) const {
    const std::uint32_t* const other = slices_.other.data() + k;
    return four_rows(rows, other[0], other[1], other[2], other[3]);
  }

  HWY_INLINE Started start(const Own<damping>& own, std::size_t k) const {
    Started quad;
    quad.along = transposed(load_rows(others(ring_.position(0), k))) - own.position;
    quad.square = dot(quad.along, quad.along);
    quad.length = hn::Sqrt(quad.square);
    return quad;
  }

  HWY_INLINE void finish(const Own<damping>& own, const Started& quad, std::size_t k, Vector3<QV>& sum) const {
    const Quad d;
    const Vector3<QV>& along = quad.along;
    const QV rest_length = hn::Load(d, slices_.rest_length.data() + k);
    QV scale = elastic_scale(d, quad.length, rest_length, hn::Load(d, slices_.stiffness.data() + k));
    Vector3<QV> relative;
    if constexpr (damping != SpringDamping::none)
      relative = transposed(load_rows(others(ring_.velocity(0), k))) - own.velocity;
    if constexpr (damping == SpringDamping::projected)
      scale = hn::Add(scale, damping_scale(d, quad.square, dot(along, relative), rest_length,
                                           hn::Load(d, slices_.damping.data() + k)));
    Vector3<QV> force{hn::Mul(scale, along.x), hn::Mul(scale, along.y), hn::Mul(scale, along.z)};
    if constexpr (damping == SpringDamping::relative) {
      const QV c = hn::Load(d, slices_.damping.data() + k);
      force = {hn::Add(force.x, hn::Mul(c, relative.x)), hn::Add(force.y, hn::Mul(c, relative.y)),
               hn::Add(force.z, hn::Mul(c, relative.z))};
    }
    sum = {hn::Add(sum.x, force.x), hn::Add(sum.y, force.y), hn::Add(sum.z, force.z)};
    subtract(rows_from(force), others(ring_.sum(0), k));
  }

  const SpringSlices& slices_;
  const SliceRing<damping> ring_;
  Own<damping> own_;
  Started quad_;
};

#else  // two doubles to a vector: plain arithmetic is as fast, and has the same bits

using Plain = std::array<double, 3>;

inline Plain difference(const double* a, const double* b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Plain& a, const Plain& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The forces of the springs of slices: off the springs' other ends, and their sums onto the slices' own particles.
template <SpringDamping damping>
class SliceForces {
 public:
  SliceForces(const SpringSlices& slices, const SliceRing<damping>& ring, int, std::size_t)
      : slices_(slices), ring_(ring) {}

  void take(int slice, std::size_t at, std::size_t) const {
    constexpr std::size_t row = SliceRing<damping>::row;
    double sum[slice_lanes][3] = {};
    for (std::size_t k = place(slice); k != place(slice + 1); ++k) {
      const std::size_t lane = k % slice_lanes;
      const Plain force = force_of(at + row * lane, k);
      double* const other = ring_.sum(slices_.other[k]);
      for (std::size_t axis = 0; axis < 3; ++axis) sum[lane][axis] += force[axis], other[axis] -= force[axis];
    }
    for (std::size_t lane = 0; lane < slice_lanes; ++lane)
      for (std::size_t axis = 0; axis < 3; ++axis) ring_.sum(at + row * lane)[axis] += sum[lane][axis];
  }

 private:
  std::size_t place(int slice) const {
    return static_cast<std::size_t>(slice_lanes * std::ptrdiff_t{slices_.begin[static_cast<std::size_t>(slice)]});
  }

  Plain force_of(std::size_t i, std::size_t k) const {
    const std::size_t j = slices_.other[k];
    const double rest_length = slices_.rest_length[k];
    const Plain along = difference(ring_.position(j), ring_.position(i));
    const double square = dot(along, along), length = std::sqrt(square);
    double scale = std::min(length, rest_length) > 0.0 ? slices_.stiffness[k] * (length - rest_length) / length : 0.0;
    Plain relative = {};
    if constexpr (damping != SpringDamping::none) relative = difference(ring_.velocity(j), ring_.velocity(i));
    if constexpr (damping == SpringDamping::projected)
      scale += std::min(square, rest_length) > 0.0 ? slices_.damping[k] * dot(along, relative) / square : 0.0;
    Plain force;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      force[axis] = scale * along[axis];
      if constexpr (damping == SpringDamping::relative) force[axis] += slices_.damping[k] * relative[axis];
    }
    return force;
  }

  const SpringSlices& slices_;
  const SliceRing<damping> ring_;
};

#endif

/// One sweep over slices [begin, end), and over those around them whose springs reach them.
template <SpringDamping damping>
class SliceSweep {
 public:
  SliceSweep(const SpringSlices& slices, const SpringColumns& columns, double* const out[3], PartScratch& scratch)
      : slices_(slices), columns_(columns), out_(out) {
    scratch.ring.resize(SliceRing<damping>::row * static_cast<std::size_t>(slices.ring));
    ring_.rows = scratch.ring.data();
  }

  void run(int begin, int end) {
    const int first = std::max(begin - slices_.reach, 0), last = std::min(end + slices_.reach, slices_.slices);
    int loaded = std::max(first - slices_.reach, 0), done = begin;
    const auto load_around = [&](int slice) {
      for (const int needed = std::min(slice + slices_.reach + 1, slices_.slices); loaded < needed; ++loaded)
        load(loaded);
    };
    load_around(first);
    SliceForces<damping> forces(slices_, ring_, first, row(first));
    for (int slice = first; slice < last; ++slice) {
      load_around(slice + 1);
      forces.take(slice, row(slice), row(slice + 1));
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
        to[0] = column[0][i], to[1] = column[1][i], to[2] = column[2][i];
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
      out_[0][i] = sum[0], out_[1][i] = sum[1], out_[2][i] = sum[2];
    }
  }

  const SpringSlices& slices_;
  const SpringColumns& columns_;
  double* const* const out_;
  SliceRing<damping> ring_;
};

}  // namespace

void sum_springs_of_slices(const SpringSlices& slices, const SpringColumns& columns, double* const sum[3], int begin,
                           int end, PartScratch& scratch) {
  SpringColumns whole;
  for (int axis = 0; axis < 3; ++axis) {
    whole.position[axis] = columns.position[axis] + slices.first_particle;
    whole.velocity[axis] = columns.velocity[axis] + slices.first_particle;
  }
  if (!slices.damped)
    SliceSweep<SpringDamping::none>(slices, whole, sum, scratch).run(begin, end);
  else if (slices.damping_model == DampingModel::projected)
    SliceSweep<SpringDamping::projected>(slices, whole, sum, scratch).run(begin, end);
  else
    SliceSweep<SpringDamping::relative>(slices, whole, sum, scratch).run(begin, end);
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

HWY_EXPORT(sum_springs_of_slices);
HWY_EXPORT(put_sums_of_columns);

void sum_springs(const SpringSlices& slices, const SpringColumns& columns, double* const sum[3], int begin, int end,
                 PartScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(sum_springs_of_slices)(slices, columns, sum, begin, end, scratch);
}

void put_sums(const SpringSink& sink, const double* const sum[3], int begin, int end) {
  HWY_DYNAMIC_DISPATCH(put_sums_of_columns)(sink, sum, begin, end);
}

}  // namespace billow::sim
#endif
