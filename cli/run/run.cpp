// Counting frames.
#include "cli/run/run.h"

#include <algorithm>
#include <cmath>

namespace billow::cli {

long frame_count(const Scene& scene) {
  return std::max(1L, static_cast<long>(std::ceil(scene.duration * scene.render.fps - 1e-9)));
}

}  // namespace billow::cli
