// Where the picture is taken from: fitting a camera to a box, and the matrices that GL draws with.
#pragma once

#include <Eigen/Geometry>

#include "render/image/settings.h"

namespace billow::render {

/// `camera` with eye and look_at such that all of `box` [m] lies inside the frame with a margin, seen from the front
/// right and slightly above. A degenerate box is treated as a small one. aspect = width / height.
Camera fit_camera(const Camera& camera, const Eigen::AlignedBox3d& box, double aspect);

/// The axis-aligned box around what `camera` frames at the distance of the point that it looks at, as deep as it is
/// high. aspect = width / height.
Eigen::AlignedBox3d framed_box(const Camera& camera, double aspect);

/// World -> view: the eye at the origin, looking along -z, y up. Looking straight up or down is allowed.
Eigen::Matrix4d view_matrix(const Camera& camera);

/// View -> clip for a pinhole camera. near, far in m, 0 < near < far.
Eigen::Matrix4d perspective(double vertical_fov, double aspect, double near, double far);

/// View -> clip that maps `box`, given in view space, onto the clip cube.
Eigen::Matrix4d orthographic(const Eigen::AlignedBox3d& box);

/// The smallest axis-aligned box around `box` moved by `transform` (affine).
Eigen::AlignedBox3d transformed_box(const Eigen::AlignedBox3d& box, const Eigen::Matrix4d& transform);

}  // namespace billow::render
