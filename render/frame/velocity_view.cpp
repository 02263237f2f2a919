// The velocity view: bodies in the colours of their velocities, before plain grey.
#include <algorithm>
#include <string>

#include "render/frame/body_programs.h"
#include "render/frame/geometry_pass.h"
#include "render/frame/shaders.h"
#include "render/frame/view_drawing.h"
#include "render/image/colour_map.h"

namespace billow::render {
namespace {

constexpr GLenum ramp_unit = 0, surface_unit = 1;
constexpr float backdrop = 0.045f;  // linear light: neutral, darker than a body at rest

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
      : velocity_(frame.gl(), "velocity", shaders::surface_vertex, fragment_for(frame.settings.velocity_colour),
                  frame.albedos),
        ramp_(make_ramp(frame.gl())) {
    velocity_.set_up([&](const Program& program) {
      program.set("velocity_range", static_cast<float>(frame.velocity_range));
      program.set("shading", static_cast<float>(frame.settings.velocity_shading));
    });
    if (frame.settings.velocity_shading == 0.0) exact_ = std::make_unique<GeometryPass>(frame, Scenery::left_out);
  }

  Picture draw(FrameParts& frame) const override {
    Image image =
        frame.draw_tiles(frame.settings.background.none, [&](const PixelBox& covered) { paint(frame, covered); });
    if (exact_) put_exact(frame, image);
    return image;
  }

 private:
  void paint(FrameParts& frame, const PixelBox& covered) const {
    frame.target.bind_plain();
    const float grey = frame.settings.background.none ? 0.0f : backdrop;
    frame.gl().ClearColor(grey, grey, grey, frame.settings.background.none ? 0.0f : 1.0f);
    frame.gl().Clear(GL_COLOR_BUFFER_BIT);
    if (covered.empty()) return;
    frame.target.bind_sampled(covered);
    velocity_.set_up([&](const Program& program) {
      program.set("view_projection", frame.stage.view_projection);
      program.set("eye", frame.stage.camera.eye);
    });
    bind_texture(frame.gl(), ramp_unit, ramp_.name());
    for (const Albedo& albedo : frame.albedos) {
      if (albedo.scenery) continue;
      velocity_.use_for(albedo, surface_unit);
      frame.meshes[albedo.body].draw(albedo.triangles);
    }
    frame.surroundings.fill_behind_bodies(frame.target);
    frame.target.resolve(covered);
  }

  // GL's way to sRGB and back rounds otherwise than the formula: pixels that a body fills get its colour as it is.
  void put_exact(FrameParts& frame, Image& image) const {
    exact_->draw(frame, [&](int x, int y, std::span<const GeometrySample> hits) {
      if (static_cast<int>(hits.size()) < exact_->samples_per_pixel()) return;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const GeometrySample& hit : hits) sum += hit.velocity;
      const Eigen::Vector3d velocity = sum / static_cast<double>(hits.size());
      const Rgb8 colour = frame.settings.velocity_colour == VelocityColour::components
                              ? velocity_rgb(velocity, frame.velocity_range)
                              : magnitude_rgb(velocity.norm() / frame.velocity_range);
      std::copy(colour.begin(), colour.end(), image.row(y) + image.channels * x);
    });
  }

  BodyPrograms velocity_;
  GlObject ramp_;
  std::unique_ptr<GeometryPass> exact_;  // where colours are not shaded
};

}  // namespace

std::unique_ptr<ViewPainter> make_velocity_painter(const FrameParts& frame, const std::vector<DrawnBody>&) {
  return std::make_unique<VelocityPainter>(frame);
}

}  // namespace billow::render
