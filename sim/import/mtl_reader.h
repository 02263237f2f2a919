// Material libraries of OBJ files.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/mesh/material.h"

namespace billow::sim {

/// The materials of an MTL file: Kd (sRGB, as screens show it), map_Kd, d or Tr, map_d. A material with a texture keeps
/// a white colour: programs write any Kd beside one. What shapes light and is not used is told to `ignore`.
std::vector<Material> read_mtl(std::string bytes, const std::function<void(const std::string&)>& ignore);

}  // namespace billow::sim
