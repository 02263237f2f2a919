// Colours as scenes write them: sRGB, "#rrggbb" or [r, g, b] in [0, 1].
#pragma once

#include <Eigen/Core>
#include <string>

#include "cli/yaml/yaml_reader.h"

namespace billow::cli {

/// The linear-light RGB of a colour in the file. Throws InputError.
Eigen::Vector3f read_colour(const Node& node, std::string_view name);

/// The same for the key of a map, which it enters in the map's record. The default is given in linear light.
Eigen::Vector3f read_colour(MapReader& map, std::string_view key, const Eigen::Vector3f& fallback);

/// The value of a key that holds a colour; null when the key is missing. Throws InputError on a key without a value.
const Node* find_colour(const MapReader& map, std::string_view key);

/// "#rrggbb" nearest to a linear-light RGB.
std::string hex_colour(const Eigen::Vector3f& linear);

}  // namespace billow::cli
