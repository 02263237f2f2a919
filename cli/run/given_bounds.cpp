// From the settings and the state at the start.
#include "cli/run/given_bounds.h"

#include "render/frame/camera.h"
#include "render/image/camera_motion.h"

namespace billow::cli {

std::optional<render::RunBounds> given_bounds(const Run& run) {
  const render::Settings& settings = run.scene.render;
  const bool ground_given = !settings.ground || settings.ground_height.has_value();
  if (settings.camera.fitted || !ground_given || !settings.velocity_range) return std::nullopt;
  const double aspect = static_cast<double>(settings.width) / settings.height;
  render::RunBounds bounds;
  bounds.velocity_scale = *settings.velocity_range;
  bounds.box = run.drawn.box(run.simulation.initial_state());
  for (const render::Camera& camera : render::cameras_along(settings.camera))
    bounds.box.extend(render::framed_box(camera, aspect));
  return bounds;
}

}  // namespace billow::cli
