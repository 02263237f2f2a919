// Cameras and projections. Column vectors: clip = projection * view * world.
#include "render/frame/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace billow::render {
namespace {

constexpr double fit_azimuth = 0.42;    // [rad] to the right of straight in front (+z)
constexpr double fit_elevation = 0.20;  // [rad] above the horizon
constexpr double fit_margin = 0.90;     // share of the frame that the box may take, either way

Eigen::Vector3d fit_direction() {
  return {std::cos(fit_elevation) * std::sin(fit_azimuth), std::sin(fit_elevation),
          std::cos(fit_elevation) * std::cos(fit_azimuth)};
}

// Rows: the camera's right, up and backward directions in the world.
Eigen::Matrix3d axes(const Eigen::Vector3d& backward) {
  const Eigen::Vector3d back = backward.normalized();
  Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(back);
  if (right.norm() < 1e-6) right = Eigen::Vector3d::UnitX();  // straight up or down: any right will do
  right.normalize();
  Eigen::Matrix3d rows;
  rows << right.transpose(), back.cross(right).transpose(), back.transpose();
  return rows;
}

Eigen::AlignedBox3d inflated(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return {Eigen::Vector3d::Constant(-0.5), Eigen::Vector3d::Constant(0.5)};
  const double least = std::max(1e-3, 1e-2 * box.diagonal().norm());
  const Eigen::Vector3d half = (0.5 * box.sizes()).cwiseMax(0.5 * least);
  return {box.center() - half, box.center() + half};
}

}  // namespace

// In axes (right, up, forward) a point p is in frame when |p_x - e_x| <= t (p_f - e_f), t the half-width at unit
// distance. With A = max(p_x - t p_f) and B = max(-p_x - t p_f) over the corners this is e_x - t e_f >= A and
// -e_x - t e_f >= B: the nearest eye has e_f = -(A + B) / 2t and e_x = (A - B) / 2. Likewise upwards; the smaller e_f
// serves both.
Camera fit_camera(const Camera& camera, const Eigen::AlignedBox3d& box, double aspect) {
  const Eigen::AlignedBox3d target = inflated(box);
  const Eigen::Matrix3d to_camera = axes(fit_direction());
  const Eigen::Vector2d tangent = fit_margin * std::tan(0.5 * camera.vertical_fov) * Eigen::Vector2d(aspect, 1.0);
  Eigen::Array2d a = Eigen::Array2d::Constant(-std::numeric_limits<double>::infinity()), b = a;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d p = to_camera * target.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    const Eigen::Array2d reach = tangent.array() * -p.z();
    a = a.max(p.head<2>().array() - reach);
    b = b.max(-p.head<2>().array() - reach);
  }
  const double forward = (-(a + b) / (2.0 * tangent.array())).minCoeff();
  Camera fitted = camera;
  fitted.eye = to_camera.transpose() * Eigen::Vector3d(0.5 * (a - b).x(), 0.5 * (a - b).y(), -forward);
  const double distance = (to_camera.row(2) * (fitted.eye - target.center())).value();
  fitted.look_at = fitted.eye - distance * to_camera.row(2).transpose();
  return fitted;
}

Eigen::AlignedBox3d framed_box(const Camera& camera, double aspect) {
  const Eigen::Vector3d backward = camera.eye - camera.look_at;
  const double half_height = backward.norm() * std::tan(0.5 * camera.vertical_fov);
  const Eigen::Vector3d half =
      axes(backward).cwiseAbs().transpose() * (half_height * Eigen::Vector3d(aspect, 1.0, 1.0));
  return {camera.look_at - half, camera.look_at + half};
}

Eigen::Matrix4d view_matrix(const Camera& camera) {
  const Eigen::Matrix3d rotation = axes(camera.eye - camera.look_at);
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.topLeftCorner<3, 3>() = rotation;
  view.topRightCorner<3, 1>() = -rotation * camera.eye;
  return view;
}

Eigen::Matrix4d perspective(double vertical_fov, double aspect, double near, double far) {
  const double f = 1.0 / std::tan(0.5 * vertical_fov);
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  projection(0, 0) = f / aspect;
  projection(1, 1) = f;
  projection(2, 2) = (far + near) / (near - far);
  projection(2, 3) = 2.0 * far * near / (near - far);
  projection(3, 2) = -1.0;
  return projection;
}

Eigen::Matrix4d orthographic(const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d scale = 2.0 * box.sizes().cwiseInverse().cwiseProduct(Eigen::Vector3d(1.0, 1.0, -1.0));
  Eigen::Matrix4d projection = Eigen::Matrix4d::Identity();
  projection.topLeftCorner<3, 3>() = scale.asDiagonal();
  projection.topRightCorner<3, 1>() = -scale.cwiseProduct(box.center());
  return projection;
}

Eigen::AlignedBox3d transformed_box(const Eigen::AlignedBox3d& box, const Eigen::Matrix4d& transform) {
  Eigen::AlignedBox3d result;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    result.extend((transform * corner.homogeneous()).head<3>());
  }
  return result;
}

}  // namespace billow::render
