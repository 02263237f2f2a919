// Solids that a scene names instead of a mesh file: closed, facing outwards, of triangles and quads of even size, with
// texture coordinates.
#pragma once

#include <Eigen/Core>

#include "sim/mesh/mesh.h"

namespace billow::sim {

/// A ball of `radius` [m] > 0. All its vertices lie on the sphere: the faces are at most 0.08 % of the radius inside.
/// The texture goes once around the y axis, its middle facing +z, its upper edge at the top.
Mesh sphere_mesh(const Eigen::Vector3d& centre, double radius);

/// All points within `radius` [m] > 0 of the segment between two different points. The texture goes once around it,
/// its lower edge at the end beyond `from`.
Mesh capsule_mesh(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

/// A cylinder of `radius` [m] > 0 between the centres of its flat ends, two different points. The texture goes once
/// around its side and lies as a whole on each end.
Mesh cylinder_mesh(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

/// A box of `size` [m] > 0 along its own axes, turned about its centre. The whole texture lies on each of its sides.
Mesh box_mesh(const Eigen::Vector3d& centre, const Eigen::Vector3d& size, const Eigen::Matrix3d& rotation);

}  // namespace billow::sim
