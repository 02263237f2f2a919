// Rows of four, compiled once for each instruction set; products and sums are rounded one by one and taken in the rows'
// order, so all sets give the same bits.
#include "sim/pass/level_pass.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/pass/level_pass.cpp"
#include <hwy/foreach_target.h>
// After foreach_target: it includes the rest of this file again for each instruction set.
#include <hwy/highway.h>

#include "sim/pass/vector_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace billow::sim::HWY_NAMESPACE {

using RowTag = hn::CappedTag<double, 4>;
constexpr int row_lanes = static_cast<int>(hn::MaxLanes(RowTag()));
constexpr int row_vectors = 4 / row_lanes;

/// One row in as many vectors as it takes.
struct RowSum {
  hn::Vec<RowTag> part[row_vectors];

  HWY_INLINE void clear() {
    for (int k = 0; k < row_vectors; ++k) part[k] = hn::Zero(RowTag());
  }
  HWY_INLINE void set_product(double weight, const double* row) {
    const RowTag d;
    for (int k = 0; k < row_vectors; ++k) part[k] = hn::Mul(hn::Set(d, weight), hn::Load(d, row + k * row_lanes));
  }
  HWY_INLINE void add_product(double weight, const double* row) {
    const RowTag d;
    for (int k = 0; k < row_vectors; ++k)
      part[k] = hn::Add(part[k], hn::Mul(hn::Set(d, weight), hn::Load(d, row + k * row_lanes)));
  }
  HWY_INLINE void add(const SparseRows& rows, int r, const double* from) {
    const auto first = static_cast<std::size_t>(rows.first[static_cast<std::size_t>(r)]);
    const auto last = static_cast<std::size_t>(rows.first[static_cast<std::size_t>(r) + 1]);
    for (std::size_t e = first; e < last; ++e) add_product(rows.weight[e], from + 4 * std::ptrdiff_t{rows.column[e]});
  }
  HWY_INLINE void store(double* row) const {
    for (int k = 0; k < row_vectors; ++k) hn::Store(part[k], RowTag(), row + k * row_lanes);
  }
};

void put_momenta(const FilterColumns& columns, int first_particle, const double* mass, double* row, int begin,
                 int end) {
  const double* in[3];
  for (int axis = 0; axis < 3; ++axis) in[axis] = columns.in[axis] + first_particle;
  rows_of(in, begin, end, row + 4 * std::ptrdiff_t{begin});
  for (int i = begin; i < end; ++i) {
    RowSum product;
    product.set_product(mass[i], row + 4 * std::ptrdiff_t{i});
    product.store(row + 4 * std::ptrdiff_t{i});
  }
}

void restrict_rows(const SparseRows& restriction, const double* fine, double* coarse, int begin, int end) {
  for (int r = begin; r < end; ++r) {
    RowSum sum;
    sum.clear();
    sum.add(restriction, r, fine);
    sum.store(coarse + 4 * std::ptrdiff_t{r});
  }
}

void interpolate_rows(const SparseRows& interpolation, const double* coarse, const double* share, double* fine,
                      int begin, int end) {
  for (int r = begin; r < end; ++r) {
    double* const row = fine + 4 * std::ptrdiff_t{r};
    RowSum sum;
    sum.set_product(share[r], row);
    if (coarse) sum.add(interpolation, r, coarse);
    sum.store(row);
  }
}

void put_interpolated(const SparseRows& interpolation, const double* coarse, double share, const FilterColumns& columns,
                      int first_particle, int begin, int end) {
  for (int i = begin; i < end; ++i) {
    const bool empty =
        interpolation.first[static_cast<std::size_t>(i)] == interpolation.first[static_cast<std::size_t>(i) + 1];
    RowSum sum;
    sum.clear();
    sum.add(interpolation, i, coarse);
    HWY_ALIGN double row[4];
    sum.store(row);
    const int place = first_particle + i;
    for (int axis = 0; axis < 3; ++axis) {
      const double in = columns.in[axis][place];
      columns.put(axis, place, empty ? in : share * in + row[axis]);
    }
  }
}

}  // namespace billow::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace billow::sim {

HWY_EXPORT(put_momenta);
HWY_EXPORT(restrict_rows);
HWY_EXPORT(interpolate_rows);
HWY_EXPORT(put_interpolated);

void put_momenta(const FilterColumns& columns, int first_particle, const double* mass, double* row, int begin,
                 int end) {
  HWY_DYNAMIC_DISPATCH(put_momenta)(columns, first_particle, mass, row, begin, end);
}

void restrict_rows(const SparseRows& restriction, const double* fine, double* coarse, int begin, int end) {
  HWY_DYNAMIC_DISPATCH(restrict_rows)(restriction, fine, coarse, begin, end);
}

void interpolate_rows(const SparseRows& interpolation, const double* coarse, const double* share, double* fine,
                      int begin, int end) {
  HWY_DYNAMIC_DISPATCH(interpolate_rows)(interpolation, coarse, share, fine, begin, end);
}

void put_interpolated(const SparseRows& interpolation, const double* coarse, double share, const FilterColumns& columns,
                      int first_particle, int begin, int end) {
  HWY_DYNAMIC_DISPATCH(put_interpolated)(interpolation, coarse, share, columns, first_particle, begin, end);
}

}  // namespace billow::sim
#endif
