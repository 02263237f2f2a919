// Passes that draw the whole picture or a square of ground.
#include "render/frame/surroundings.h"

#include <string>

#include "render/frame/shaders.h"

namespace billow::render {
namespace {

const Eigen::Vector3f shadow_tint(0.44f, 0.46f, 0.50f);  // light left in full shadow, a little cool

std::string with_gradient(const char* fragment) { return std::string(fragment) + shaders::gradient_functions; }

GroundPatch ground_square(const Stage& stage) {
  const double half_side = ground_extent * stage.radius;
  return {stage.shadow_patch.centre, half_side * Eigen::Vector3d::UnitZ(), half_side * Eigen::Vector3d::UnitX()};
}

void set_square(const Program& program, const Stage& stage, const GroundPatch& square) {
  program.use();
  program.set("view_projection", stage.view_projection);
  program.set("centre", square.centre);
  program.set("half_u", square.half_u);
  program.set("half_v", square.half_v);
}

void set_gradient(const Program& program, const Background& background, int height) {
  program.use();
  program.set("top", background.top);
  program.set("bottom", background.bottom);
  program.set("frame_height", static_cast<float>(height));
}

}  // namespace

Surroundings::Surroundings(const Gl& gl, const Settings& settings, const Stage& stage, int drawn_height)
    : gl_(&gl),
      has_background_(!settings.background.none),
      has_ground_(settings.ground && has_background_),
      has_shade_(has_ground_ || (settings.ground && settings.shadow_only)),
      background_(gl, "background", shaders::screen_vertex, with_gradient(shaders::background_fragment)),
      ground_(gl, "ground", shaders::ground_vertex, with_gradient(shaders::ground_fragment)),
      shade_(gl, "shade", shaders::ground_vertex,
             has_background_ ? shaders::shade_fragment : shaders::shadow_alpha_fragment),
      copy_(gl, "copy", shaders::screen_vertex, shaders::copy_fragment),
      copy_ground_(gl, "copy ground", shaders::ground_vertex, shaders::copy_fragment),
      no_vertices_(make_vertex_array(gl)) {
  set_gradient(background_, settings.background, drawn_height);
  set_gradient(ground_, settings.background, drawn_height);
  ground_.set("floor_colour", settings.background.bottom);
  set_square(ground_, stage, ground_square(stage));
  set_square(copy_ground_, stage, ground_square(stage));
  set_square(shade_, stage, stage.shadow_patch);
  shade_.set("shadow_tint", shadow_tint);
}

void Surroundings::see_from(const Stage& stage) const {
  for (const Program* program : {&ground_, &copy_ground_, &shade_}) {
    program->use();
    program->set("view_projection", stage.view_projection);
  }
}

void Surroundings::draw_backdrop(const FrameTarget& target) const {
  const Eigen::Vector2f corner(static_cast<float>(target.tile().left), static_cast<float>(target.tile().bottom));
  target.bind_plain();
  if (has_background_) {
    background_.use();
    background_.set("tile_corner", corner);
    draw_screen();
  } else {
    gl_->ClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    gl_->Clear(GL_COLOR_BUFFER_BIT);
  }
  if (has_ground_) {
    ground_.use();
    ground_.set("tile_corner", corner);
    draw_ground_square();
  }
  target.keep_backdrop();
}

// The shadow multiplies the ground that is already there; without one it is an alpha before nothing.
void Surroundings::draw_shade(const FrameTarget& target, GLuint shadow) const {
  if (!has_shade_) return;
  target.bind_plain();
  shade_.use();
  bind_texture(*gl_, 0, shadow);
  if (has_background_) {
    gl_->Enable(GL_BLEND);
    gl_->BlendFunc(GL_DST_COLOR, GL_ZERO);
  }
  draw_ground_square();
  gl_->Disable(GL_BLEND);
}

void Surroundings::fill_behind_ground(const FrameTarget& target) const {
  if (!has_shade_) return;
  copy_ground_.use();
  bind_texture(*gl_, 0, target.plain_texture());
  draw_ground_square();
}

void Surroundings::fill_behind_bodies(const FrameTarget& target) const {
  copy_.use();
  bind_texture(*gl_, 0, target.plain_texture());
  draw_screen();
}

void Surroundings::draw_ground_square() const {
  gl_->BindVertexArray(no_vertices_.name());
  gl_->Enable(GL_CULL_FACE);  // from below there is no ground
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  gl_->Disable(GL_CULL_FACE);
}

void Surroundings::draw_screen() const {
  gl_->BindVertexArray(no_vertices_.name());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace billow::render
