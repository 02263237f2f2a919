// Highway compiles this file once for each instruction set and picks the best one at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/linear/stiffness_product.cpp"
#include <hwy/foreach_target.h>
// foreach_target.h must come first
#include <hwy/highway.h>

#include "sim/linear/stiffness_product.h"

HWY_BEFORE_NAMESPACE();
namespace billow::sim::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Wide = hn::CappedTag<double, 8>;  // no wider than the shortest distance of a run that is added in one go
using Single = hn::CappedTag<double, 1>;

/// Three numbers for each slot of a piece.
struct Buffer {
  static constexpr int size = ProductPlan::Piece::max_slots;
  HWY_ALIGN double x[size], y[size], z[size];
};

/// Raw columns of a particle field.
template <class T>
struct Columns {
  T *x, *y, *z;
  Columns at(int row) const { return {x + row, y + row, z + row}; }
};

template <class V>
struct Vector3 {
  V x, y, z;
};

// Calls `body(d, k)` for k in [0, count), a vector at a time and then one by one.
template <class Body>
HWY_INLINE void each_vector(int count, const Body& body) {
  const int lanes = static_cast<int>(hn::Lanes(Wide()));
  int k = 0;
  for (; k + lanes <= count; k += lanes) body(Wide(), k);
  for (; k < count; ++k) body(Single(), k);
}

template <class D, class T>
HWY_INLINE auto load(D d, const Columns<T>& from, int k) {
  return Vector3<hn::Vec<D>>{hn::LoadU(d, from.x + k), hn::LoadU(d, from.y + k), hn::LoadU(d, from.z + k)};
}

template <class D, class V>
HWY_INLINE void add(D d, const Vector3<V>& v, const Columns<double>& to, int k) {
  hn::StoreU(hn::Add(hn::LoadU(d, to.x + k), v.x), d, to.x + k);
  hn::StoreU(hn::Add(hn::LoadU(d, to.y + k), v.y), d, to.y + k);
  hn::StoreU(hn::Add(hn::LoadU(d, to.z + k), v.z), d, to.z + k);
}

template <class D, class V>
HWY_INLINE void subtract(D d, const Vector3<V>& v, const Columns<double>& to, int k) {
  hn::StoreU(hn::Sub(hn::LoadU(d, to.x + k), v.x), d, to.x + k);
  hn::StoreU(hn::Sub(hn::LoadU(d, to.y + k), v.y), d, to.y + k);
  hn::StoreU(hn::Sub(hn::LoadU(d, to.z + k), v.z), d, to.z + k);
}

// a d + b (u . d) u of the slots from `s` on
template <class D, class V>
HWY_INLINE Vector3<V> multiplied(D d, const BlockColumns& blocks, int s, const Vector3<V>& difference) {
  const auto& [dx, dy, dz] = difference;
  const V ux = hn::LoadU(d, blocks.ux + s), uy = hn::LoadU(d, blocks.uy + s), uz = hn::LoadU(d, blocks.uz + s);
  const V a = hn::LoadU(d, blocks.isotropic + s);
  const V dot = hn::Add(hn::Add(hn::Mul(ux, dx), hn::Mul(uy, dy)), hn::Mul(uz, dz));
  const V b = hn::Mul(hn::LoadU(d, blocks.along + s), dot);
  return {hn::Add(hn::Mul(a, dx), hn::Mul(b, ux)), hn::Add(hn::Mul(a, dy), hn::Mul(b, uy)),
          hn::Add(hn::Mul(a, dz), hn::Mul(b, uz))};
}

// Of the slots from `s` on, with x at their first and at their second particles.
template <class D, class T>
HWY_INLINE auto force(D d, const BlockColumns& blocks, int s, const Columns<T>& first, const Columns<T>& second,
                      int k) {
  const auto i = load(d, first, k), j = load(d, second, k);
  return multiplied(d, blocks, s, Vector3<hn::Vec<D>>{hn::Sub(i.x, j.x), hn::Sub(i.y, j.y), hn::Sub(i.z, j.z)});
}

// Every particle is a second end before it is a first one, whatever the width of the vectors.
HWY_INLINE void add_far_run(const BlockColumns& blocks, const ProductPlan::Piece& piece, const Columns<const double>& x,
                            const Columns<double>& out) {
  const auto x_first = x.at(piece.first), x_second = x.at(piece.second);
  const auto first = out.at(piece.first), second = out.at(piece.second);
  each_vector(piece.count, [&](auto d, int k) HWY_ATTR {
    const auto f = force(d, blocks, piece.begin + k, x_first, x_second, k);
    add(d, f, first, k);
    subtract(d, f, second, k);
  });
}

// The ends of a vector's springs may overlap here: onto all first particles, then off all second ones.
HWY_INLINE void add_near_run(const BlockColumns& blocks, const ProductPlan::Piece& piece,
                             const Columns<const double>& x, const Columns<double>& out, Buffer& buffer) {
  const auto x_first = x.at(piece.first), x_second = x.at(piece.second);
  const auto first = out.at(piece.first), second = out.at(piece.second);
  const Columns<double> kept{buffer.x, buffer.y, buffer.z};
  each_vector(piece.count, [&](auto d, int k) HWY_ATTR {
    const auto f = force(d, blocks, piece.begin + k, x_first, x_second, k);
    add(d, f, first, k);
    hn::StoreU(f.x, d, kept.x + k), hn::StoreU(f.y, d, kept.y + k), hn::StoreU(f.z, d, kept.z + k);
  });
  each_vector(piece.count, [&](auto d, int k) HWY_ATTR { subtract(d, load(d, kept, k), second, k); });
}

HWY_INLINE void add_loose(const ProductPlan& plan, const BlockColumns& blocks, const ProductPlan::Piece& piece,
                          const Columns<const double>& x, const Columns<double>& out, Buffer& buffer) {
  const int *first = plan.first.data() + piece.begin, *second = plan.second.data() + piece.begin;
  for (int k = 0; k < piece.count; ++k) {
    const int i = first[k], j = second[k];
    buffer.x[k] = x.x[i] - x.x[j], buffer.y[k] = x.y[i] - x.y[j], buffer.z[k] = x.z[i] - x.z[j];
  }
  const Columns<double> kept{buffer.x, buffer.y, buffer.z};
  each_vector(piece.count, [&](auto d, int k) HWY_ATTR {
    const auto f = multiplied(d, blocks, piece.begin + k, load(d, kept, k));
    hn::StoreU(f.x, d, kept.x + k), hn::StoreU(f.y, d, kept.y + k), hn::StoreU(f.z, d, kept.z + k);
  });
  for (int k = 0; k < piece.count; ++k) {
    const int i = first[k], j = second[k];
    out.x[i] += buffer.x[k], out.y[i] += buffer.y[k], out.z[i] += buffer.z[k];
    out.x[j] -= buffer.x[k], out.y[j] -= buffer.y[k], out.z[j] -= buffer.z[k];
  }
}

void add_product_vectorised(const ProductPlan& plan, const BlockColumns& blocks, const Eigen::MatrixX3d& x,
                            Eigen::MatrixX3d& out) {
  const Columns<const double> from{x.col(0).data(), x.col(1).data(), x.col(2).data()};
  const Columns<double> to{out.col(0).data(), out.col(1).data(), out.col(2).data()};
  Buffer buffer;
  for (const ProductPlan::Piece& piece : plan.pieces)
    if (piece.loose)
      add_loose(plan, blocks, piece, from, to, buffer);
    else if (piece.second - piece.first >= 8)
      add_far_run(blocks, piece, from, to);
    else
      add_near_run(blocks, piece, from, to, buffer);
}

// a I + b u u^T of the slots from `s` on
template <class D>
HWY_INLINE auto straight_of(D d, const BlockColumns& blocks, int s) {
  const auto ux = hn::LoadU(d, blocks.ux + s), uy = hn::LoadU(d, blocks.uy + s), uz = hn::LoadU(d, blocks.uz + s);
  const auto a = hn::LoadU(d, blocks.isotropic + s), b = hn::LoadU(d, blocks.along + s);
  return Vector3<hn::Vec<D>>{hn::Add(a, hn::Mul(hn::Mul(b, ux), ux)), hn::Add(a, hn::Mul(hn::Mul(b, uy), uy)),
                             hn::Add(a, hn::Mul(hn::Mul(b, uz), uz))};
}

template <class D>
HWY_INLINE auto mixed_of(D d, const BlockColumns& blocks, int s) {
  const auto ux = hn::LoadU(d, blocks.ux + s), uy = hn::LoadU(d, blocks.uy + s), uz = hn::LoadU(d, blocks.uz + s);
  const auto b = hn::LoadU(d, blocks.along + s);
  return Vector3<hn::Vec<D>>{hn::Mul(hn::Mul(b, ux), uy), hn::Mul(hn::Mul(b, ux), uz), hn::Mul(hn::Mul(b, uy), uz)};
}

// One end of a run after the other, so that the order of the sums is that of the slots.
HWY_INLINE void add_run_blocks(const BlockColumns& blocks, const ProductPlan::Piece& piece,
                               const Columns<double>& straight, const Columns<double>& mixed) {
  for (const int particle : {piece.first, piece.second})
    each_vector(piece.count, [&](auto d, int k) HWY_ATTR {
      add(d, straight_of(d, blocks, piece.begin + k), straight.at(particle), k);
      add(d, mixed_of(d, blocks, piece.begin + k), mixed.at(particle), k);
    });
}

HWY_INLINE void add_loose_blocks(const ProductPlan& plan, const BlockColumns& blocks, const ProductPlan::Piece& piece,
                                 const Columns<double>& straight, const Columns<double>& mixed) {
  for (int s = piece.begin; s < piece.begin + piece.count; ++s)
    for (const int particle : {plan.first[s], plan.second[s]}) {
      add(Single(), straight_of(Single(), blocks, s), straight.at(particle), 0);
      add(Single(), mixed_of(Single(), blocks, s), mixed.at(particle), 0);
    }
}

void add_diagonal_blocks_vectorised(const ProductPlan& plan, const BlockColumns& blocks, Eigen::MatrixX3d& straight,
                                    Eigen::MatrixX3d& mixed) {
  const Columns<double> s{straight.col(0).data(), straight.col(1).data(), straight.col(2).data()};
  const Columns<double> m{mixed.col(0).data(), mixed.col(1).data(), mixed.col(2).data()};
  for (const ProductPlan::Piece& piece : plan.pieces)
    piece.loose ? add_loose_blocks(plan, blocks, piece, s, m) : add_run_blocks(blocks, piece, s, m);
}

}  // namespace
}  // namespace billow::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace billow::sim {

HWY_EXPORT(add_product_vectorised);

void add_product(const ProductPlan& plan, const BlockColumns& blocks, const Eigen::MatrixX3d& x,
                 Eigen::MatrixX3d& out) {
  HWY_DYNAMIC_DISPATCH(add_product_vectorised)(plan, blocks, x, out);
}

HWY_EXPORT(add_diagonal_blocks_vectorised);

void add_diagonal_blocks(const ProductPlan& plan, const BlockColumns& blocks, Eigen::MatrixX3d& straight,
                         Eigen::MatrixX3d& mixed) {
  HWY_DYNAMIC_DISPATCH(add_diagonal_blocks_vectorised)(plan, blocks, straight, mixed);
}

}  // namespace billow::sim
#endif
