// A drawn mesh bound to a fish's particles.
#pragma once

#include "sim/fish.h"
#include "sim/mesh.h"
#include "sim/skin.h"

namespace billow::sim {

/// Binds `mesh`, drawn in the body axes of a fish of length 1 (snout at x = 0.5, tail at -0.5, back to +y), to the
/// particles of a fish of any length. A point keeps its height and its distance to the side in a frame that travels
/// with the body: the frame's origin runs along a smooth curve through the middles of the stations, its up and side
/// directions blend those of the rings. All three are linear in the particles, and smooth along the body to the second
/// derivative, so the skin bends without kinks; at rest the mesh is exact.
Skin bind_fish_skin(const Mesh& mesh);

/// The skin between the particles, for a fish without a mesh.
Skin plain_fish_skin();

}  // namespace billow::sim
