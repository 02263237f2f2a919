// What is known of a run before its first frame is drawn: its bodies, and the room and the speeds they take up.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "render/image/finish.h"
#include "sim/drawn/surface.h"

namespace billow::render {

/// One body as the renderer needs it for a whole run.
struct DrawnBody {
  sim::Surface surface;
  std::vector<Finish> finish = {1, Finish()};  // of the surface's materials, one at least
  std::string name = {};                       // by which the data view knows it
  bool scenery = false;                        // shows the way that others make: the velocity view leaves it out
};

/// What holds for every frame of a run and is known before the first one is drawn.
struct RunBounds {
  Eigen::AlignedBox3d box;      // [m]   all positions of all frames: fits the camera, the ground and the shadow map
  double velocity_scale = 1.0;  // [m/s] v_max of the velocity view when the settings give none
};

}  // namespace billow::render
