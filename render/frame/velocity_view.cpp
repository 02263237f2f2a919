// The velocity view: bodies in the colours of their velocities, before plain grey.
#include <algorithm>
#include <string>

#include "render/frame/shaders.h"
#include "render/frame/view_drawing.h"
#include "render/image/colour_map.h"

namespace billow::render {
namespace {

constexpr float backdrop = 0.82f;  // linear light: neutral, brighter than a body at rest

Image ramp_image() {
  Image image(256, 1, 3);
  for (int x = 0; x < image.width; ++x) {
    const Rgb8 colour = magnitude_rgb(x / 255.0);
    std::copy(colour.begin(), colour.end(), image.row(0) + 3 * x);
  }
  return image;
}

GlObject make_ramp(const Gl& gl) {
  GlObject texture = make_colour_texture(gl, ramp_image(), GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);  // a ramp has no place for mipmaps
  return texture;
}

std::string fragment_for(VelocityColour colour) {
  const bool components = colour == VelocityColour::components;
  return std::string(shaders::velocity_fragment) + (components ? shaders::component_colour : shaders::magnitude_colour);
}

class VelocityPainter : public ViewPainter {
 public:
  explicit VelocityPainter(const FrameParts& frame)
      : velocity_(frame.gl(), "velocity", shaders::surface_vertex, fragment_for(frame.settings.velocity_colour)),
        ramp_(make_ramp(frame.gl())) {
    velocity_.use();
    velocity_.set("view_projection", frame.stage.view_projection);
    velocity_.set("eye", frame.stage.camera.eye);
    velocity_.set("velocity_range", static_cast<float>(frame.velocity_range));
    velocity_.set("shading", static_cast<float>(frame.settings.velocity_shading));
  }

  void draw(FrameParts& frame) const override {
    frame.target.bind_plain();
    frame.gl().ClearColor(backdrop, backdrop, backdrop, 1.0f);
    frame.gl().Clear(GL_COLOR_BUFFER_BIT);
    if (frame.covered.empty()) return;
    frame.target.bind_sampled(frame.covered);
    velocity_.use();
    bind_texture(frame.gl(), 0, ramp_.name());
    for (const BodyMesh& mesh : frame.meshes) mesh.draw();
    frame.surroundings.fill_behind_bodies(frame.target);
    frame.target.resolve(frame.covered);
  }

 private:
  Program velocity_;
  GlObject ramp_;
};

}  // namespace

std::unique_ptr<ViewPainter> make_velocity_painter(const FrameParts& frame, const std::vector<DrawnBody>&) {
  return std::make_unique<VelocityPainter>(frame);
}

}  // namespace billow::render
