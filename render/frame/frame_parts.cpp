// Setting up a run's GL, and moving its bodies.
#include "render/frame/frame_parts.h"

#include <stdexcept>

namespace billow::render {

FrameParts::FrameParts(const Settings& chosen, const std::vector<DrawnBody>& bodies, const RunBounds& bounds,
                       int threads)
    : settings(chosen),
      velocity_range(chosen.velocity_range.value_or(bounds.velocity_scale)),
      box(bounds.box),
      stage(make_stage(chosen, bounds.box)),
      context(threads),
      target(gl(), context.limits(), chosen.width, chosen.height, chosen.samples),
      shadow(gl(), stage),
      surroundings(gl(), chosen, stage, target.drawn_height()) {
  for (const DrawnBody& body : bodies) meshes.emplace_back(gl(), body.surface);
  gl().Enable(GL_FRAMEBUFFER_SRGB);
  gl().DepthFunc(GL_LEQUAL);  // what fills the screen lies exactly at the far plane
  gl().BlendFunc(GL_DST_COLOR, GL_ZERO);
  surroundings.draw_backdrop(target);
}

void FrameParts::update(const std::vector<sim::SurfaceState>& states) {
  if (states.size() != meshes.size()) throw std::invalid_argument("draw() wants one state for each body");
  const Eigen::Matrix4f view_projection = stage.view_projection.cast<float>();
  covered = {};
  for (std::size_t b = 0; b < meshes.size(); ++b) {
    meshes[b].update(states[b]);
    covered = joined(covered,
                     covered_pixels(states[b].position, view_projection, target.drawn_width(), target.drawn_height()));
  }
}

}  // namespace billow::render
