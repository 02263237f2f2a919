// A drawn mesh bound to a fish's particles.
#pragma once

#include "sim/body/fish.h"
#include "sim/drawn/skin.h"
#include "sim/mesh/mesh.h"

namespace billow::sim {

/// Binds `mesh`, drawn in the body axes of a fish of length 1 (snout at x = 0.5, tail at -0.5, back to +y), to the
/// particles of a fish of `length` [m]. A point keeps its height and its distance to the side in a frame that travels
/// with the body: the frame's origin runs along a smooth curve through the middles of the stations, its up and side
/// directions blend those of the rings, smooth along the body to the second derivative. So the skin bends without kinks
/// and twists without pinching; at rest the mesh is exact.
Skin bind_fish_skin(const Mesh& mesh, double length);

/// Weights of the particles (rows x 23) that give `rows` places evenly along the axis of a fish, from snout to tail.
Eigen::MatrixXd fish_axis(int rows);

/// The skin between the particles, for a fish without a mesh.
Skin plain_fish_skin();

}  // namespace billow::sim
