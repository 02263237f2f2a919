// What of a scene touches what.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/contact/collider.h"
#include "sim/mesh/mesh.h"

namespace billow::sim {

/// How a body touches others. Two surfaces stay apart by the mean of their bodies' thicknesses, of a body and a
/// collider by half of the body's and all of the collider's; the friction between two is the geometric mean of theirs.
struct BodyContact {
  bool touches = false;      // false: it passes through everything, and costs nothing
  bool self = true;          // it touches itself
  double thickness = 0.002;  // [m] of the cloth
  double friction = 0.3;     // Coulomb's
  std::vector<Face> face;    // corners are particles of the body, counted from its first
};

struct ContactOptions {
  std::vector<BodyContact> body;  // one for each of the structure's
  std::vector<Collider> collider;
};

}  // namespace billow::sim
