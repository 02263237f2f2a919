// Keys of a rigid motion in a scene: of pins and colliders.
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "cli/yaml/yaml_reader.h"
#include "sim/body/keyed_motion.h"

namespace billow::cli {

/// The list under `key`, each entry {time: [s], translate: [m], rotate: [degrees]}; a missing or empty list, which is
/// also what is then entered, moves nothing. Throws InputError located at a key that is no later than the one before.
std::vector<sim::PlaceKey> read_place_keys(MapReader& map, std::string_view key);

/// The motion through them, turning about `pivot` [m].
sim::KeyedMotion read_motion(MapReader& map, std::string_view key, const Eigen::Vector3d& pivot);

}  // namespace billow::cli
