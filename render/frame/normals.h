// Smooth normals of a drawn surface.
#pragma once

#include <Eigen/Core>

#include "sim/drawn/surface.h"

namespace billow::render {

/// Unit normals (p x 3), one per point and so continuous across texture seams: the triangles' normals weighted by their
/// angle at the point (Thuermer & Wuethrich 1998), which does not depend on how a flat polygon was split. Zero where a
/// point has no triangle of non-zero area. `position` (p x 3) [m].
Eigen::MatrixX3f point_normals(const sim::Surface& surface, const Eigen::MatrixX3f& position);

}  // namespace billow::render
