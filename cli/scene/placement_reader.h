// Where a scene puts a mesh: scaled, turned, shifted.
#pragma once

#include <Eigen/Core>

#include "base/words.h"
#include "cli/yaml/yaml_reader.h"
#include "sim/mesh/mesh.h"

namespace billow::cli {

/// What one unit of a mesh file's coordinates is.
enum class LengthUnit { metre, decimetre, centimetre, millimetre, kilometre, inch, foot };
Words<LengthUnit> words(LengthUnit);

/// position -> rotation * scale * (z_up: (x, z, -y), or as it is) * unit + translation
struct Placement {
  LengthUnit unit = LengthUnit::metre;
  bool z_up = false;                                // the file's up is z, the scene's y
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  // along the scene's axes, before it is turned
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  // [m]
};

/// rotate: [x, y, z] in degrees about the fixed axes, or a map with the keys of `axis_angle`; none: identity.
Eigen::Matrix3d read_rotation(MapReader& map, const Section& axis_angle);

/// unit:, z_up:, scale:, rotate: and translate: of a transform.
Placement read_placement(MapReader& transform, const Section& axis_angle);

/// The mesh where it is put.
sim::Mesh placed(const sim::Mesh& mesh, const Placement& placement);

}  // namespace billow::cli
