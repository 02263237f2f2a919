// Where a scene puts a mesh: scaled, turned, shifted.
#pragma once

#include <Eigen/Core>

#include "cli/yaml/yaml_reader.h"
#include "sim/mesh/mesh.h"

namespace billow::cli {

struct Placement {
  double scale = 1.0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  // [m]
};

/// rotate: [x, y, z] in degrees about the fixed axes, or a map with the keys of `axis_angle`; none: identity.
Eigen::Matrix3d read_rotation(MapReader& map, const Section& axis_angle);

/// scale:, rotate: and translate: of a transform.
Placement read_placement(MapReader& transform, const Section& axis_angle);

/// The mesh where it is put.
sim::Mesh placed(const sim::Mesh& mesh, const Placement& placement);

}  // namespace billow::cli
