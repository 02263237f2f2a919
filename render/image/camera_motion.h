// Cameras that move.
#pragma once

#include <vector>

#include "render/image/settings.h"

namespace billow::render {

/// The camera at `time` [s]. Between keys eye, look_at and the angle of view each follow a monotone cubic (Fritsch &
/// Butland 1984): through every key, without a kink and without overshooting; still before the first key and after the
/// last. A turntable then turns the eye about the vertical through look_at, counter-clockwise seen from above.
Camera camera_at(const Camera& camera, double time);

inline bool moves(const Camera& camera) { return !camera.keys.empty() || camera.turn_period > 0.0; }

/// Cameras along the whole way, near enough to each other to tell what all of it frames.
std::vector<Camera> cameras_along(const Camera& camera);

}  // namespace billow::render
