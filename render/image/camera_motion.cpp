// Interpolation between keys, and the turn.
#include "render/image/camera_motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

namespace billow::render {
namespace {

using Values = Eigen::Array<double, 7, 1>;  // eye, look_at, angle of view

Values values_of(const CameraKey& key) {
  Values values;
  values << key.eye.array(), key.look_at.array(), key.vertical_fov;
  return values;
}

// [1/s] at key k: the harmonic mean of the slopes to both sides, zero at an extremum, at the first key and at the last.
Values slope_at(const std::vector<CameraKey>& keys, std::size_t k) {
  if (k == 0 || k + 1 == keys.size()) return Values::Zero();
  const double before = keys[k].time - keys[k - 1].time, after = keys[k + 1].time - keys[k].time;
  const Values from = (values_of(keys[k]) - values_of(keys[k - 1])) / before;
  const Values to = (values_of(keys[k + 1]) - values_of(keys[k])) / after;
  const double w_from = 2.0 * after + before, w_to = after + 2.0 * before;
  Values slope;
  for (int i = 0; i < slope.size(); ++i)
    slope(i) = from(i) * to(i) > 0.0 ? (w_from + w_to) / (w_from / from(i) + w_to / to(i)) : 0.0;
  return slope;
}

Values interpolated(const std::vector<CameraKey>& keys, double time) {
  if (time <= keys.front().time) return values_of(keys.front());
  if (time >= keys.back().time) return values_of(keys.back());
  const auto next =
      std::upper_bound(keys.begin(), keys.end(), time, [](double t, const CameraKey& key) { return t < key.time; });
  const auto k = static_cast<std::size_t>(next - keys.begin()) - 1;
  const double h = keys[k + 1].time - keys[k].time, t = (time - keys[k].time) / h, s = 1.0 - t;
  return s * s * (1.0 + 2.0 * t) * values_of(keys[k]) + t * t * (1.0 + 2.0 * s) * values_of(keys[k + 1]) +
         h * t * s * (s * slope_at(keys, k) - t * slope_at(keys, k + 1));
}

}  // namespace

Camera camera_at(const Camera& camera, double time) {
  Camera now = camera;
  if (!camera.keys.empty()) {
    const Values values = interpolated(camera.keys, time);
    now.eye = values.segment<3>(0), now.look_at = values.segment<3>(3);
    now.vertical_fov = values(6);
  }
  if (camera.turn_period > 0.0) {
    const Eigen::AngleAxisd turn(2.0 * std::numbers::pi * time / camera.turn_period, Eigen::Vector3d::UnitY());
    now.eye = now.look_at + turn * (now.eye - now.look_at);
  }
  return now;
}

std::vector<Camera> cameras_along(const Camera& camera) {
  constexpr int between = 16;  // steps from one key to the next, and of a turn
  std::vector<Camera> cameras = {camera_at(camera, 0.0)};
  for (std::size_t k = 0; k + 1 < camera.keys.size(); ++k)
    for (int step = 0; step <= between; ++step)
      cameras.push_back(
          camera_at(camera, camera.keys[k].time + (camera.keys[k + 1].time - camera.keys[k].time) * step / between));
  if (camera.turn_period > 0.0)
    for (int step = 0; step < between; ++step)
      cameras.push_back(camera_at(camera, camera.turn_period * step / between));
  return cameras;
}

}  // namespace billow::render
