// Keys -> monotone cubics -> rigid motion. With the secants d_k = (y_{k+1} - y_k) / (t_{k+1} - t_k), the slope at an
// inner key is the mean of the secants on its two sides, or 0 where they do not agree in sign: there the component
// turns around. On an interval whose ends have the slopes alpha d and beta d the cubic is monotone if
// alpha^2 + beta^2 <= 9, so larger ones are shortened to that circle.
#include "sim/body/keyed_motion.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"

namespace billow::sim {

namespace {

void check_times(const std::vector<double>& time) {
  for (std::size_t k = 1; k < time.size(); ++k)
    if (!(time[k] > time[k - 1]))
      throw InputError("key " + std::to_string(k) + " of the motion is no later than the one before it");
}

// The slopes at both ends of an interval with this secant, shortened.
void shorten(double secant, double& from, double& to) {
  const double length = std::hypot(from, to);
  if (length <= 3.0 * std::abs(secant)) return;
  from *= 3.0 * std::abs(secant) / length;
  to *= 3.0 * std::abs(secant) / length;
}

/// Slopes (k) of one component through its values (k) at ascending times (k); 0 at both ends.
std::vector<double> monotone_slopes(const std::vector<double>& time, const std::vector<double>& value) {
  std::vector<double> slope(time.size(), 0.0), secant;
  for (std::size_t k = 0; k + 1 < time.size(); ++k)
    secant.push_back((value[k + 1] - value[k]) / (time[k + 1] - time[k]));
  for (std::size_t k = 1; k + 1 < time.size(); ++k)
    if (secant[k - 1] * secant[k] > 0.0) slope[k] = 0.5 * (secant[k - 1] + secant[k]);
  for (std::size_t k = 0; k < secant.size(); ++k) shorten(secant[k], slope[k], slope[k + 1]);
  return slope;
}

/// A turn about one axis, and how fast its matrix changes per radian.
struct Turn {
  Turn(int axis, double angle)
      : matrix(Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis))),
        slope(-matrix.colwise().cross(Eigen::Vector3d::Unit(axis))) {}
  Eigen::Matrix3d matrix, slope;
};

}  // namespace

KeyedMotion::KeyedMotion(std::vector<PlaceKey> keys, const Eigen::Vector3d& pivot) : pivot_(pivot) {
  for (const PlaceKey& key : keys) {
    time_.push_back(key.time);
    value_.push_back((Components() << key.translation, key.rotation).finished());
  }
  check_times(time_);
  slope_.resize(keys.size());
  for (int c = 0; c < 6; ++c) {
    std::vector<double> value;
    for (const Components& components : value_) value.push_back(components(c));
    const std::vector<double> slope = monotone_slopes(time_, value);
    for (std::size_t k = 0; k < slope.size(); ++k) slope_[k](c) = slope[k];
  }
}

// The cubic of Hermite in s = (t - t_k) / h.
KeyedMotion::Place KeyedMotion::place(double time) const {
  if (time_.empty()) return {};
  const auto later = std::upper_bound(time_.begin(), time_.end(), time);
  if (later == time_.begin()) return {value_.front()};
  if (later == time_.end()) return {value_.back()};
  const auto k = static_cast<std::size_t>(later - time_.begin()) - 1;
  const double h = time_[k + 1] - time_[k], s = (time - time_[k]) / h;
  const Components rise = value_[k + 1] - value_[k];
  const double u = 1.0 - s;
  return {value_[k] + s * s * (3.0 - 2.0 * s) * rise + h * (s * u * u * slope_[k] - s * s * u * slope_[k + 1]),
          6.0 * s * u / h * rise + u * (1.0 - 3.0 * s) * slope_[k] + s * (3.0 * s - 2.0) * slope_[k + 1]};
}

// x(t) = R (x - pivot) + pivot + translation, R = R_z R_y R_x.
Eigen::Isometry3d KeyedMotion::at(double time) const {
  const Components value = place(time).value;
  const Turn x(0, value(3)), y(1, value(4)), z(2, value(5));
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = z.matrix * y.matrix * x.matrix;
  result.translation() = value.head<3>() + (pivot_ - result.linear() * pivot_);
  return result;
}

Eigen::Affine3d KeyedMotion::velocity_at(double time) const {
  const Place now = place(time);
  const Turn x(0, now.value(3)), y(1, now.value(4)), z(2, now.value(5));
  Eigen::Affine3d result;
  result.matrix().setZero();
  result.linear() = now.rate(5) * z.slope * y.matrix * x.matrix + now.rate(4) * z.matrix * y.slope * x.matrix +
                    now.rate(3) * z.matrix * y.matrix * x.slope;
  result.translation() = now.rate.head<3>() - result.linear() * pivot_;
  return result;
}

bool KeyedMotion::moves() const {
  return std::any_of(value_.begin(), value_.end(), [](const Components& value) { return !value.isZero(0.0); });
}

}  // namespace billow::sim
