// What a renderer is asked for besides pictures.
#pragma once

#include "render/gl/backend.h"
#include "render/gl/tile_limits.h"

namespace billow::render {

struct DrawingOptions {
  Backend backend = backend_of_environment();
  int threads = 0;  // that rasterise, where software does; 0: one per core. The first renderer of the process decides
                    // for all of its backend, and LP_NUM_THREADS in the environment wins. Pixels do not depend on it
  TileLimits tiles = {};
};

}  // namespace billow::render
