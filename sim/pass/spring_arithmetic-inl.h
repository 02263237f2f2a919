// The law of a linear spring and its damping on vectors of springs, and what a pass does with their sums, once for each
// instruction set. Only additions, subtractions, multiplications, divisions and square roots, each rounded as IEEE 754
// says and none contracted: all sets give the same bits.
#include "sim/pass/spring_sink.h"

#if defined(BILLOW_SIM_SPRING_ARITHMETIC_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BILLOW_SIM_SPRING_ARITHMETIC_INL_H
#undef BILLOW_SIM_SPRING_ARITHMETIC_INL_H
#else
#define BILLOW_SIM_SPRING_ARITHMETIC_INL_H
#endif

#include <hwy/highway.h>

#include "sim/pass/vector_rows-inl.h"

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
HWY_INLINE V elastic_scale(D d, V length, V rest_length, V stiffness) {
  const V scale = hn::Div(hn::Mul(stiffness, hn::Sub(length, rest_length)), length);
  return hn::IfThenElseZero(hn::Gt(hn::Min(length, rest_length), hn::Zero(d)), scale);
}

// c (d . w) / d^2: c (u . w) u along the spring, w the relative velocity.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V damping_scale(D d, V square, V along, V rest_length, V damping) {
  return hn::IfThenElseZero(hn::Gt(hn::Min(square, rest_length), hn::Zero(d)),
                            hn::Div(hn::Mul(damping, along), square));
}

/// SpringSink::put on a vector of particles.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void put(D d, const SpringSink& sink, std::ptrdiff_t i, const Vector3<V>& sums) {
  V sum[3] = {sums.x, sums.y, sums.z};
  if (!sink.mass) {
    HWY_UNROLL(3)
    for (int axis = 0; axis < 3; ++axis) hn::StoreU(sum[axis], d, sink.out[axis] + i);
    return;
  }
  if (sink.friction != 0.0) {
    const V friction = hn::Set(d, sink.friction);
    HWY_UNROLL(3)
    for (int axis = 0; axis < 3; ++axis)
      sum[axis] = hn::Sub(sum[axis], hn::Mul(friction, hn::LoadU(d, sink.velocity[axis] + i)));
  }
  const V inverse_mass = sink.inverse_mass ? hn::LoadU(d, sink.inverse_mass + i) : hn::Set(d, 1.0);
  const V step = hn::Set(d, sink.step);
  HWY_UNROLL(3)
  for (int axis = 0; axis < 3; ++axis) {
    if (sink.gravity[axis] != 0.0)
      sum[axis] = hn::Add(sum[axis], hn::Mul(hn::Set(d, sink.gravity[axis]), hn::LoadU(d, sink.mass + i)));
    if (sink.applied[axis]) sum[axis] = hn::Add(sum[axis], hn::LoadU(d, sink.applied[axis] + i));
    sum[axis] = hn::Mul(sum[axis], inverse_mass);
    if (sink.base[axis]) sum[axis] = hn::Add(hn::LoadU(d, sink.base[axis] + i), hn::Mul(step, sum[axis]));
    hn::StoreU(sum[axis], d, sink.out[axis] + i);
  }
}

}  // namespace billow::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
