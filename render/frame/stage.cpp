// Placing camera, light and ground around a run's bounding box.
#include "render/frame/stage.h"

#include <algorithm>
#include <cmath>

#include "render/frame/camera.h"
#include "render/image/camera_motion.h"

namespace billow::render {
namespace {

constexpr double ground_gap = 0.02;    // the ground lies this share of the box's diagonal below it
constexpr double stray_room = 3.0;     // [radius] for bodies that leave the box
constexpr double ground_reach = 12.0;  // [radius] at least to a corner of the drawn ground: sqrt(2) extents
static_assert(ground_reach * ground_reach >= 2.0 * ground_extent * ground_extent);
const Eigen::Vector3d key_light(-0.78, 1.35, 0.50);  // right, up, towards the camera
const Eigen::Vector3d fill_light(1.00, 0.25, 0.40);

Eigen::AlignedBox3d sound_box(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return {Eigen::Vector3d::Constant(-0.5), Eigen::Vector3d::Constant(0.5)};
  const Eigen::Vector3d least = Eigen::Vector3d::Constant(std::max(1e-3, 1e-3 * box.diagonal().norm()));
  return {box.min() - least, box.max() + least};
}

// Lights keep their place relative to the camera, so that whatever it looks at is lit from the front and the sides.
Eigen::Vector3d direction_from(const Eigen::Matrix4d& view, const Eigen::Vector3d& right_up_back) {
  const Eigen::Vector3d right = view.row(0).head<3>().transpose();
  const Eigen::Vector3d back = right.cross(Eigen::Vector3d::UnitY());
  const Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  return (right_up_back.x() * right + right_up_back.y() * up + right_up_back.z() * back).normalized();
}

Eigen::Matrix4d light_view(const Eigen::Vector3d& to_light) {
  Camera light;
  light.eye = to_light;
  light.look_at.setZero();
  return view_matrix(light);
}

double ground_height(const Settings& settings, const Eigen::AlignedBox3d& box) {
  return settings.ground_height.value_or(box.min().y() - ground_gap * box.diagonal().norm());
}

// The box's shadow, widened by the penumbra at its far end.
GroundPatch shadow_patch(const Stage& stage, const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d along = Eigen::Vector3d(stage.to_light.x(), 0.0, stage.to_light.z()).normalized();
  const Eigen::Vector3d across = Eigen::Vector3d::UnitY().cross(along);
  Eigen::AlignedBox2d shadow;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    const Eigen::Vector3d hit = corner - stage.to_light * ((corner.y() - stage.ground_height) / stage.to_light.y());
    shadow.extend(Eigen::Vector2d(hit.dot(along), hit.dot(across)));
  }
  const double penumbra = 2.0 * light_spread * std::max(box.max().y() - stage.ground_height, 0.0) / stage.to_light.y();
  const Eigen::Vector2d half = (0.5 * shadow.sizes()).array() + penumbra + 0.1 * stage.radius;
  const Eigen::Vector3d centre =
      along * shadow.center().x() + across * shadow.center().y() + Eigen::Vector3d::UnitY() * stage.ground_height;
  return {centre, along * half.x(), across * half.y()};
}

// The near plane leaves room for bodies that stray out of the box; the far one takes in all of the drawn ground, whose
// middle is no farther from the box's than that room where the ground lies just below the box.
Eigen::Matrix4d camera_projection(const Settings& settings, const Stage& stage, const Eigen::AlignedBox3d& box) {
  const double distance = (stage.camera.eye - box.center()).norm();
  const double near = std::max(0.02 * distance, distance - stray_room * stage.radius);
  const double far = distance + (ground_reach + stray_room) * stage.radius;
  const double aspect = double(settings.width) / settings.height;
  return perspective(stage.camera.vertical_fov, aspect, near, far);
}

// What of `box` is seen while it is turned about its vertical middle.
Eigen::AlignedBox3d turned_box(const Eigen::AlignedBox3d& box) {
  const double reach = 0.5 * std::hypot(box.sizes().x(), box.sizes().z());
  const Eigen::Vector3d half(reach, 0.5 * box.sizes().y(), reach);
  return {box.center() - half, box.center() + half};
}

}  // namespace

Camera still_camera(const Settings& settings, const Eigen::AlignedBox3d& bounds) {
  const Camera& camera = settings.camera;
  if (!camera.fitted) return camera;
  const Eigen::AlignedBox3d box = sound_box(bounds);
  if (camera.turn_period == 0.0) return fit_camera(camera, box, double(settings.width) / settings.height);
  // It turns around the box's middle, wherever the fit would look.
  Camera fitted = fit_camera(camera, turned_box(box), double(settings.width) / settings.height);
  fitted.eye += box.center() - fitted.look_at;
  fitted.look_at = box.center();
  return fitted;
}

void set_camera(Stage& stage, const Settings& settings, const Eigen::AlignedBox3d& bounds, const Camera& camera) {
  stage.camera = camera;
  stage.view_projection = camera_projection(settings, stage, sound_box(bounds)) * view_matrix(camera);
}

Stage make_stage(const Settings& settings, const Eigen::AlignedBox3d& bounds) {
  const Eigen::AlignedBox3d box = sound_box(bounds);
  Stage stage;
  stage.radius = 0.5 * box.diagonal().norm();
  stage.ground_height = ground_height(settings, box);
  set_camera(stage, settings, bounds, camera_at(still_camera(settings, bounds), 0.0));
  const Eigen::Matrix4d view = view_matrix(stage.camera);
  stage.to_light = direction_from(view, key_light);
  stage.to_fill = direction_from(view, fill_light);
  const Eigen::Matrix4d to_light_view = light_view(stage.to_light);
  const Eigen::AlignedBox3d light_box = transformed_box(box, to_light_view);
  stage.light_projection = orthographic(light_box) * to_light_view;
  stage.light_size = light_box.sizes();
  stage.shadow_patch = shadow_patch(stage, box);
  return stage;
}

}  // namespace billow::render
