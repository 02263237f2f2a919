// Setting up a run's GL, and moving its bodies.
#include "render/frame/frame_parts.h"

#include <stdexcept>

#include "render/image/camera_motion.h"

namespace billow::render {

FrameParts::FrameParts(const Settings& chosen, const std::vector<DrawnBody>& bodies, const RunBounds& bounds,
                       const DrawingOptions& options)
    : settings(chosen),
      velocity_range(chosen.velocity_range.value_or(bounds.velocity_scale)),
      box(bounds.box),
      camera(still_camera(chosen, bounds.box)),
      stage(make_stage(chosen, bounds.box)),
      next_camera(stage.camera),
      tile_limits(options.tiles),
      context(options.backend, options.threads),
      target(gl(), context.limits(), chosen.width, chosen.height, chosen.samples, tile_limits),
      albedos(make_albedos(gl(), bodies)),
      shadow(gl(), stage, albedos),
      surroundings(gl(), chosen, stage, target.drawn_height()) {
  for (const DrawnBody& body : bodies) meshes.emplace_back(gl(), body.surface);
  gl().Enable(GL_FRAMEBUFFER_SRGB);
  gl().DepthFunc(GL_LEQUAL);  // what fills the screen lies exactly at the far plane
}

// The backdrop is then seen from elsewhere too.
void FrameParts::move_camera(double time) {
  if (!moves(camera)) return;
  set_camera(stage, settings, box, camera_at(camera, time));
  next_camera = camera_at(camera, time + 1.0 / settings.fps);
  surroundings.see_from(stage);
  backdrop_tile.reset();
}

Image FrameParts::draw_tiles(bool with_alpha, const std::function<void(const PixelBox& covered)>& paint) {
  Image picture(settings.width, settings.height, with_alpha ? 4 : 3);
  for (const PixelBox& tile : target.tiles()) {
    target.turn_to(tile);
    paint(overlap(covered, tile));
    target.read_into(picture);
  }
  return picture;
}

// What a still camera sees of a picture of one tile is drawn once.
void FrameParts::recall_backdrop() {
  if (backdrop_tile == target.tile()) return target.recall_backdrop();
  surroundings.draw_backdrop(target);
  backdrop_tile = target.tile();
}

void FrameParts::update(const std::vector<sim::SurfaceState>& states, double time) {
  if (states.size() != meshes.size()) throw std::invalid_argument("draw() wants one state for each body");
  move_camera(time);
  const Eigen::Matrix4f view_projection = stage.view_projection.cast<float>();
  covered = {};
  for (std::size_t b = 0; b < meshes.size(); ++b) {
    meshes[b].update(states[b]);
    covered = joined(covered,
                     covered_pixels(states[b].position, view_projection, target.drawn_width(), target.drawn_height()));
  }
}

}  // namespace billow::render
