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

void restrict_by_rows(const SparseRows& restriction, const double* fine, double* coarse, int begin, int end) {
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

void put_by_rows(const SparseRows& interpolation, const double* coarse, double share, const FilterColumns& columns,
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

// One row of a grid, summed down the columns: sums (columns rows of four) = sum over its fine rows of weight m f.
void sum_down(const AxisInterpolation& down, int node, int width, const double* const in[3], const double* mass,
              double* sums) {
  const auto first = static_cast<std::size_t>(down.restriction.first[static_cast<std::size_t>(node)]);
  const auto last = static_cast<std::size_t>(down.restriction.first[static_cast<std::size_t>(node) + 1]);
  int x = 0;
#if HWY_MAX_BYTES >= 32
  const Quad d;
  for (; x + 4 <= width; x += 4) {
    Vector3<QV> sum{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    for (std::size_t e = first; e < last; ++e) {
      const std::ptrdiff_t i = std::ptrdiff_t{down.restriction.column[e]} * width + x;
      const QV weight = hn::Mul(hn::Set(d, down.restriction.weight[e]), hn::LoadU(d, mass + i));
      sum.x = hn::Add(sum.x, hn::Mul(weight, hn::LoadU(d, in[0] + i)));
      sum.y = hn::Add(sum.y, hn::Mul(weight, hn::LoadU(d, in[1] + i)));
      sum.z = hn::Add(sum.z, hn::Mul(weight, hn::LoadU(d, in[2] + i)));
    }
    const Rows rows = rows_from(sum);
    hn::Store(rows.a, d, sums + 4 * x), hn::Store(rows.b, d, sums + 4 * x + 4);
    hn::Store(rows.c, d, sums + 4 * x + 8), hn::Store(rows.e, d, sums + 4 * x + 12);
  }
#endif
  for (; x < width; ++x) {
    double* const sum = sums + 4 * x;
    sum[0] = sum[1] = sum[2] = sum[3] = 0.0;
    for (std::size_t e = first; e < last; ++e) {
      const std::ptrdiff_t i = std::ptrdiff_t{down.restriction.column[e]} * width + x;
      const double weight = down.restriction.weight[e] * mass[i];
      for (int axis = 0; axis < 3; ++axis) sum[axis] += weight * in[axis][i];
    }
  }
}

void restrict_grid(const GridInterpolation& grid, const FilterColumns& columns, int first_particle, const double* mass,
                   double* coarse, int begin, int end, PartScratch& scratch) {
  const int width = grid.along.fine();
  scratch.rows.resize(4 * static_cast<std::size_t>(width));
  const double* in[3];
  for (int axis = 0; axis < 3; ++axis) in[axis] = columns.in[axis] + first_particle;
  for (int node = begin; node < end; ++node) {
    sum_down(grid.down, node, width, in, mass, scratch.rows.data());
    restrict_by_rows(grid.along.restriction, scratch.rows.data(),
                     coarse + 4 * std::ptrdiff_t{node} * grid.along.nodes(), 0, grid.along.nodes());
  }
}

// One coarse row at the places of a fine one: out[axis * stride + x].
void interpolate_along(const AxisInterpolation& along, const double* nodes, double* out, std::ptrdiff_t stride) {
  const int width = along.fine();
  int x = 0;
#if HWY_MAX_BYTES >= 32
  const Quad d;
  const auto at = [&](int place) HWY_ATTR {
    const auto p = static_cast<std::size_t>(place);
    return hn::Add(hn::Mul(hn::Set(d, along.lower_weight[p]), hn::Load(d, nodes + 4 * std::ptrdiff_t{along.lower[p]})),
                   hn::Mul(hn::Set(d, along.upper_weight[p]), hn::Load(d, nodes + 4 * std::ptrdiff_t{along.upper[p]})));
  };
  for (; x + 4 <= width; x += 4) {
    const Vector3<QV> four = transposed({at(x), at(x + 1), at(x + 2), at(x + 3)});
    hn::Store(four.x, d, out + x), hn::Store(four.y, d, out + stride + x), hn::Store(four.z, d, out + 2 * stride + x);
  }
#endif
  for (; x < width; ++x) {
    const auto p = static_cast<std::size_t>(x);
    for (int axis = 0; axis < 3; ++axis)
      out[axis * stride + x] = along.lower_weight[p] * nodes[4 * std::ptrdiff_t{along.lower[p]} + axis] +
                               along.upper_weight[p] * nodes[4 * std::ptrdiff_t{along.upper[p]} + axis];
  }
}

/// What a row of particles is made of: share in + (lower_weight lower + upper_weight upper).
struct RowParts {
  const double *lower, *upper;
  double lower_weight, upper_weight, share;
};

void put_row(const FilterColumns& columns, int axis, int first, int width, const RowParts& parts) {
  const hn::CappedTag<double, 4> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const double* const in = columns.in[axis] + first;
  int x = 0;
  for (; x + lanes <= width; x += lanes) {
    const auto smooth = hn::Add(hn::Mul(hn::Set(d, parts.lower_weight), hn::Load(d, parts.lower + x)),
                                hn::Mul(hn::Set(d, parts.upper_weight), hn::Load(d, parts.upper + x)));
    auto value = hn::Add(hn::Mul(hn::Set(d, parts.share), hn::LoadU(d, in + x)), smooth);
    if (const double* const base = columns.base[axis])
      value = hn::Add(hn::LoadU(d, base + first + x), hn::Mul(hn::Set(d, columns.kick_step), value));
    hn::StoreU(value, d, columns.out[axis] + first + x);
    if (double* const moved = columns.moved[axis])
      hn::StoreU(hn::Add(hn::LoadU(d, moved + first + x), hn::Mul(hn::Set(d, columns.move_step), value)), d,
                 moved + first + x);
  }
  for (; x < width; ++x)
    columns.put(axis, first + x,
                parts.share * in[x] + (parts.lower_weight * parts.lower[x] + parts.upper_weight * parts.upper[x]));
}

void put_interpolated_grid(const GridInterpolation& grid, const SparseRows& interpolation, const double* coarse,
                           double share, const FilterColumns& columns, int first_particle, int begin, int end,
                           PartScratch& scratch) {
  const int width = grid.along.fine();
  const std::ptrdiff_t stride = (width + 7) / 8 * 8;
  scratch.rows.resize(static_cast<std::size_t>(6 * stride));
  double* lower = scratch.rows.data();
  double* upper = lower + 3 * stride;
  int lower_node = -1, upper_node = -1;
  const auto fill = [&](int node, int& holds, double* row) HWY_ATTR {
    if (holds != node)
      interpolate_along(grid.along, coarse + 4 * std::ptrdiff_t{node} * grid.along.nodes(), row, stride);
    holds = node;
  };
  for (int y = begin; y < end; ++y) {
    const auto r = static_cast<std::size_t>(y);
    if (grid.pinned[r]) {
      put_by_rows(interpolation, coarse, share, columns, first_particle, y * width, (y + 1) * width);
      continue;
    }
    if (grid.down.lower[r] == upper_node) std::swap(lower, upper), std::swap(lower_node, upper_node);
    fill(grid.down.lower[r], lower_node, lower);
    fill(grid.down.upper[r], upper_node, upper);
    for (int axis = 0; axis < 3; ++axis)
      put_row(
          columns, axis, first_particle + y * width, width,
          {lower + axis * stride, upper + axis * stride, grid.down.lower_weight[r], grid.down.upper_weight[r], share});
  }
}

}  // namespace billow::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace billow::sim {

HWY_EXPORT(put_momenta);
HWY_EXPORT(restrict_by_rows);
HWY_EXPORT(interpolate_rows);
HWY_EXPORT(put_by_rows);
HWY_EXPORT(restrict_grid);
HWY_EXPORT(put_interpolated_grid);

void put_momenta(const FilterColumns& columns, int first_particle, const double* mass, double* row, int begin,
                 int end) {
  HWY_DYNAMIC_DISPATCH(put_momenta)(columns, first_particle, mass, row, begin, end);
}

void restrict_rows(const SparseRows& restriction, const double* fine, double* coarse, int begin, int end) {
  HWY_DYNAMIC_DISPATCH(restrict_by_rows)(restriction, fine, coarse, begin, end);
}

void interpolate_rows(const SparseRows& interpolation, const double* coarse, const double* share, double* fine,
                      int begin, int end) {
  HWY_DYNAMIC_DISPATCH(interpolate_rows)(interpolation, coarse, share, fine, begin, end);
}

void put_interpolated(const SparseRows& interpolation, const double* coarse, double share, const FilterColumns& columns,
                      int first_particle, int begin, int end) {
  HWY_DYNAMIC_DISPATCH(put_by_rows)(interpolation, coarse, share, columns, first_particle, begin, end);
}

void restrict_grid(const GridInterpolation& grid, const FilterColumns& columns, int first_particle, const double* mass,
                   double* coarse, int begin, int end, PartScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(restrict_grid)(grid, columns, first_particle, mass, coarse, begin, end, scratch);
}

void put_interpolated_grid(const GridInterpolation& grid, const SparseRows& interpolation, const double* coarse,
                           double share, const FilterColumns& columns, int first_particle, int begin, int end,
                           PartScratch& scratch) {
  HWY_DYNAMIC_DISPATCH(put_interpolated_grid)
  (grid, interpolation, coarse, share, columns, first_particle, begin, end, scratch);
}

}  // namespace billow::sim
#endif
