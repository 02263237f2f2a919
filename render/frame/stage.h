// What a run's pictures share: camera, key light, ground. Plain numbers, no GL.
#pragma once

#include <Eigen/Geometry>

#include "render/image/settings.h"

namespace billow::render {

/// A rectangle on the ground around every shadow that the run can cast: centre + s half_u + t half_v, s, t in [-1, 1].
struct GroundPatch {
  Eigen::Vector3d centre;          // [m]
  Eigen::Vector3d half_u, half_v;  // [m]
};

/// Camera and light of a run. The light is fixed for all frames so that nothing swims: as the camera stands at first.
struct Stage {
  Camera camera;                     // of the moment; fitted where the settings ask for it
  Eigen::Matrix4d view_projection;   // world -> clip
  Eigen::Vector3d to_light;          // unit, world -> key light: over the camera's left shoulder
  Eigen::Vector3d to_fill;           // unit, world -> fill light, which casts no shadow: to the camera's right
  Eigen::Matrix4d light_projection;  // world -> the key light's clip cube, which holds the bodies
  Eigen::Vector3d light_size;        // [m] the clip cube's sides: across, up, and along the light
  double radius;                     // [m] half the diagonal of the bodies' box: the scene's unit of length
  double ground_height;              // [m] y
  GroundPatch shadow_patch;
};

/// The sine of half the angle that the key light spans: 0 casts hard shadows.
constexpr double light_spread = 0.10;

/// [radius] half the side of the square of ground that is drawn; the ground fades out over it.
constexpr double ground_extent = 8.0;

/// `box` [m] holds all positions of all frames. The camera is that of time 0.
Stage make_stage(const Settings& settings, const Eigen::AlignedBox3d& box);

/// The camera of the settings, fitted where they ask for it, before it moves.
Camera still_camera(const Settings& settings, const Eigen::AlignedBox3d& box);

/// Moves the stage's camera. `box` as make_stage had it.
void set_camera(Stage& stage, const Settings& settings, const Eigen::AlignedBox3d& box, const Camera& camera);

}  // namespace billow::render
