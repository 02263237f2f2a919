// Moving surfaces as one animated glTF 2.0 file in its binary form.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "render/frame/drawn_body.h"

namespace billow::cli {

/// One mesh of the file.
struct GlbPart {
  std::string name;
  std::string role;  // "body" or "collider": the mesh's extras, for viewers that frame the bodies
  render::DrawnBody drawn;
};

/// Where the parts are at one moment.
struct GlbKey {
  double time = 0.0;                        // [s] ascending from key to key
  std::vector<Eigen::MatrixX3f> positions;  // [m] (p x 3) of each part's points, seen from the origin
};

/// The bytes of a GLB file that is the first key and moves through the others, linearly between them; its nodes stand
/// at `origin` [m]. A part's corners are its vertices. Key k > 0 is morph target k - 1 of each part that moves; at a
/// key its weight is 1 and all others are 0. Every part has one position matrix in every key; at least one key. Throws
/// std::length_error beyond the 4 GiB that the format holds.
std::string glb_file(const std::vector<GlbPart>& parts, const std::vector<GlbKey>& keys,
                     const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

}  // namespace billow::cli
