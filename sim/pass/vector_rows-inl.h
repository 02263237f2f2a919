// What the vector passes share, once for each instruction set: particles as rows of x, y, z, 0, which a vector of four
// doubles loads from anywhere at once, and the way from columns to rows and back.
#include <cstddef>
#include <vector>

#if defined(BILLOW_SIM_VECTOR_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BILLOW_SIM_VECTOR_ROWS_INL_H
#undef BILLOW_SIM_VECTOR_ROWS_INL_H
#else
#define BILLOW_SIM_VECTOR_ROWS_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace billow::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Vector3 {
  V x, y, z;
};

inline void plain_rows_of(const double* const column[3], int begin, int end, double* rows) {
  for (int i = begin; i < end; ++i, rows += 4)
    rows[0] = column[0][i], rows[1] = column[1][i], rows[2] = column[2][i], rows[3] = 0.0;
}

#if HWY_MAX_BYTES >= 32

using Quad = hn::CappedTag<double, 4>;
using QV = hn::Vec<Quad>;

/// Four rows, by name: elements of an array do not stay in registers.
struct Rows {
  QV a, b, c, e;
};

/// The x, y and z of four rows.
HWY_INLINE Vector3<QV> transposed(const Rows& rows) {
  const Quad d;
  const auto [a, b, c, e] = rows;
  const QV xz_ab = hn::InterleaveLower(d, a, b), y_ab = hn::InterleaveUpper(d, a, b);
  const QV xz_ce = hn::InterleaveLower(d, c, e), y_ce = hn::InterleaveUpper(d, c, e);
  return {hn::ConcatLowerLower(d, xz_ce, xz_ab), hn::ConcatLowerLower(d, y_ce, y_ab),
          hn::ConcatUpperUpper(d, xz_ce, xz_ab)};
}

/// Four rows of x, y, z and a number that means nothing.
HWY_INLINE Rows rows_from(const Vector3<QV>& axes) {
  const Quad d;
  const QV xy_02 = hn::InterleaveLower(d, axes.x, axes.y), xy_13 = hn::InterleaveUpper(d, axes.x, axes.y);
  const QV z_02 = axes.z, z_13 = hn::InterleaveUpper(d, axes.z, axes.z);
  return {hn::ConcatLowerLower(d, z_02, xy_02), hn::ConcatLowerLower(d, z_13, xy_13),
          hn::ConcatUpperUpper(d, z_02, xy_02), hn::ConcatUpperUpper(d, z_13, xy_13)};
}

/// Particles [begin, end) of the columns, each as a row of four at `rows`.
inline void rows_of(const double* const column[3], int begin, int end, double* rows) {
  const Quad d;
  int i = begin;
  for (; i + 4 <= end; i += 4, rows += 16) {
    const Rows four =
        rows_from({hn::LoadU(d, column[0] + i), hn::LoadU(d, column[1] + i), hn::LoadU(d, column[2] + i)});
    hn::Store(four.a, d, rows), hn::Store(four.b, d, rows + 4);
    hn::Store(four.c, d, rows + 8), hn::Store(four.e, d, rows + 12);
  }
  plain_rows_of(column, i, end, rows);
}

#else

inline void rows_of(const double* const column[3], int begin, int end, double* rows) {
  plain_rows_of(column, begin, end, rows);
}

#endif

/// As rows_of, of the particles at places [begin, end) of `order`; of those themselves where it is empty.
inline void ordered_rows_of(const double* const column[3], const std::vector<int>& order, int begin, int end,
                            double* rows) {
  if (order.empty()) return rows_of(column, begin, end, rows);
  for (int r = begin; r < end; ++r, rows += 4) {
    const int i = order[static_cast<std::size_t>(r)];
    rows[0] = column[0][i], rows[1] = column[1][i], rows[2] = column[2][i], rows[3] = 0.0;
  }
}

}  // namespace billow::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
