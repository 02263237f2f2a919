// The natural cubic spline's cardinal functions.
#include "sim/drawn/cubic_spline.h"

#include <Eigen/LU>
#include <algorithm>

namespace billow::sim {
namespace {

// D with second derivatives = D values: continuity of the first derivative at inner knots,
//   a/6 m_(i-1) + (a + b)/3 m_i + b/6 m_(i+1) = (y_(i+1) - y_i)/b - (y_i - y_(i-1))/a,  a, b the knot spacings,
// and none of bending at the ends.
Eigen::MatrixXd second_derivatives(const Eigen::VectorXd& knot) {
  const Eigen::Index k = knot.size();
  Eigen::MatrixXd left = Eigen::MatrixXd::Identity(k, k), right = Eigen::MatrixXd::Zero(k, k);
  for (Eigen::Index i = 1; i + 1 < k; ++i) {
    const double a = knot(i) - knot(i - 1), b = knot(i + 1) - knot(i);
    left.row(i).segment<3>(i - 1) << a / 6.0, (a + b) / 3.0, b / 6.0;
    right.row(i).segment<3>(i - 1) << 1.0 / a, -1.0 / a - 1.0 / b, 1.0 / b;
  }
  return left.partialPivLu().solve(right);
}

}  // namespace

Eigen::VectorXd spline_weights(const Eigen::VectorXd& knot, double x) {
  const Eigen::MatrixXd second = second_derivatives(knot);
  const Eigen::Index last = knot.size() - 1;
  const double inside = std::clamp(x, knot(0), knot(last));
  const double* above = std::upper_bound(knot.data(), knot.data() + last, inside);
  const Eigen::Index i = std::max<Eigen::Index>(above - knot.data(), 1);
  const double h = knot(i) - knot(i - 1), t = (inside - knot(i - 1)) / h, s = 1.0 - t;
  Eigen::RowVectorXd value = h * h / 6.0 * ((s * s * s - s) * second.row(i - 1) + (t * t * t - t) * second.row(i));
  value(i - 1) += s, value(i) += t;
  if (x == inside) return value.transpose();
  Eigen::RowVectorXd slope = h / 6.0 * ((1.0 - 3.0 * s * s) * second.row(i - 1) + (3.0 * t * t - 1.0) * second.row(i));
  slope(i - 1) -= 1.0 / h, slope(i) += 1.0 / h;
  return (value + (x - inside) * slope).transpose();
}

}  // namespace billow::sim
