// Seed -> waves -> velocities of the air.
#include "sim/force/wind_field.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/random.h"

namespace billow::sim {
namespace {

// Directions, all alike likely: what of the seeded points in a cube lies in its ball. Half of them do.
class Directions {
 public:
  explicit Directions(std::uint64_t seed) : point_(seeded_noise(1024, seed)) {}
  Eigen::Vector3d next() {
    while (true) {
      const Eigen::Vector3d point = point_.row(next_++ % point_.rows()).transpose();
      const double length = point.norm();
      if (length > 0.1 && length < 1.0) return point / length;
    }
  }
  /// From -1 to 1, however the directions fell.
  double number() { return point_(point_.rows() - ++numbers_, 0); }

 private:
  Eigen::MatrixX3d point_;
  Eigen::Index next_ = 0, numbers_ = 0;
};

}  // namespace

WindField::WindField(const Eigen::Vector3d& mean, const std::optional<Gusts>& gusts) : mean_(mean) {
  if (!gusts || gusts->strength == 0.0 || mean.isZero(0.0)) return;
  wave_ = std::array<Wave, waves>();
  Directions directions(gusts->seed);
  double squares = 0.0;
  double faster = std::numbers::sqrt2 / 2.0;  // than a wave of the period
  for (Wave& wave : *wave_) {
    Eigen::Vector3d along = directions.next();
    if (along.dot(mean) < 0.0) along = -along;
    // A second direction that is nearly the first leaves nothing across it.
    Eigen::Vector3d across = along.cross(directions.next());
    while (across.norm() < 0.3) across = along.cross(directions.next());
    const double amplitude = std::pow(faster, -1.0 / 3.0);
    wave.amplitude = amplitude * across.normalized();
    wave.number = 2.0 * std::numbers::pi * faster / gusts->length * along;
    wave.frequency = 2.0 * std::numbers::pi * faster / gusts->period;
    wave.phase = std::numbers::pi * directions.number();
    squares += 0.5 * amplitude * amplitude;
    faster *= std::numbers::sqrt2;
  }
  for (Wave& wave : *wave_) wave.amplitude *= gusts->strength * mean.norm() / std::sqrt(squares);
}

Eigen::Vector3d WindField::velocity(const Eigen::Vector3d& position, double time) const {
  Eigen::Vector3d velocity = mean_;
  if (!wave_) return velocity;
  for (const Wave& wave : *wave_)
    velocity += std::sin(wave.number.dot(position) - wave.frequency * time + wave.phase) * wave.amplitude;
  return velocity;
}

Eigen::Matrix3d WindField::gradient(const Eigen::Vector3d& position, double time) const {
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  if (!wave_) return gradient;
  for (const Wave& wave : *wave_)
    gradient += std::cos(wave.number.dot(position) - wave.frequency * time + wave.phase) * wave.amplitude *
                wave.number.transpose();
  return gradient;
}

}  // namespace billow::sim
