// What a mesh file says of how its faces look.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "base/alpha_mode.h"

namespace billow::sim {

/// One material of a mesh. A texture is a file beside the mesh, or the bytes of one where the mesh's file holds it.
struct Material {
  std::string name;                                  // as the file has it
  Eigen::Vector4f colour = Eigen::Vector4f::Ones();  // RGBA, linear light, times the texture
  std::string texture;                               // path within the mesh's folder; ""
  std::string texture_bytes;                         // a PNG or JPEG file; ""
  std::string alpha_texture;                         // a file whose grey is the alpha (MTL's map_d); ""
  std::optional<AlphaMode> alpha;                    // none: as the texture has it
  float cutoff = 0.5f;                               // of cut_out
};

}  // namespace billow::sim
