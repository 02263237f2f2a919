// What the vector passes share, once for each instruction set: particles as rows of x, y, z, 0, which a vector of four
// doubles loads from anywhere at once, and the way from columns to rows and back.
#include <array>
#include <cstddef>

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

/// The x, y and z of four rows.
HWY_INLINE Vector3<QV> transposed(const std::array<QV, 4>& row) {
  const Quad d;
  const QV xz_01 = hn::InterleaveLower(d, row[0], row[1]), y_01 = hn::InterleaveUpper(d, row[0], row[1]);
  const QV xz_23 = hn::InterleaveLower(d, row[2], row[3]), y_23 = hn::InterleaveUpper(d, row[2], row[3]);
  return {hn::ConcatLowerLower(d, xz_23, xz_01), hn::ConcatLowerLower(d, y_23, y_01),
          hn::ConcatUpperUpper(d, xz_23, xz_01)};
}

/// Particles [begin, end) of the columns, each as a row of four at `rows`.
inline void rows_of(const double* const column[3], int begin, int end, double* rows) {
  const Quad d;
  int i = begin;
  for (; i + 4 <= end; i += 4, rows += 16) {
    const QV x = hn::LoadU(d, column[0] + i), y = hn::LoadU(d, column[1] + i), z = hn::LoadU(d, column[2] + i);
    const QV xy_02 = hn::InterleaveLower(d, x, y), xy_13 = hn::InterleaveUpper(d, x, y);
    const QV z_02 = hn::InterleaveLower(d, z, hn::Zero(d)), z_13 = hn::InterleaveUpper(d, z, hn::Zero(d));
    hn::Store(hn::ConcatLowerLower(d, z_02, xy_02), d, rows);
    hn::Store(hn::ConcatLowerLower(d, z_13, xy_13), d, rows + 4);
    hn::Store(hn::ConcatUpperUpper(d, z_02, xy_02), d, rows + 8);
    hn::Store(hn::ConcatUpperUpper(d, z_13, xy_13), d, rows + 12);
  }
  plain_rows_of(column, i, end, rows);
}

#else

inline void rows_of(const double* const column[3], int begin, int end, double* rows) {
  plain_rows_of(column, begin, end, rows);
}

#endif

}  // namespace billow::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
