// Scenes that say all that a survey would find out.
#pragma once

#include <optional>

#include "cli/run/run.h"

namespace billow::cli {

/// What the pictures of a run need to know of it beforehand, where its scene gives the camera, the ground (or none) and
/// velocity_range; nothing where a survey has to find some of them. The box, which lights, shadow and clipping planes
/// are placed around, is then what the camera frames and what the bodies take up at the start: the same for every
/// frame, whichever are drawn.
std::optional<render::RunBounds> given_bounds(const Run& run);

}  // namespace billow::cli
