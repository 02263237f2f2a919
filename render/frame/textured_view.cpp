// The textured view: lit bodies with their textures, and their shadows on the ground.
#include "render/frame/albedo.h"
#include "render/frame/shaders.h"
#include "render/frame/view_drawing.h"

namespace billow::render {
namespace {

constexpr float shadow_offset = 0.009f;  // [radius]
constexpr float shadow_blur = 4.5f;      // [texel] of the depth map
constexpr GLenum albedo_unit = 0, shadow_unit = 1;

class TexturedPainter : public ViewPainter {
 public:
  TexturedPainter(const FrameParts& frame, const std::vector<DrawnBody>& bodies)
      : lit_(frame.gl(), "lit", shaders::surface_vertex, shaders::lit_fragment) {
    for (const DrawnBody& body : bodies) albedos_.push_back(make_albedo(frame.gl(), body));
    set_up(frame.stage, frame.shadow);
  }

  Picture draw(FrameParts& frame) const override {
    paint(frame);
    return frame.target.read(frame.settings.background.none);
  }

 private:
  void paint(FrameParts& frame) const {
    frame.target.recall_backdrop();
    frame.shadow.update(frame.meshes);
    frame.surroundings.draw_shade(frame.target, frame.shadow.ground_texture());
    if (frame.covered.empty()) return;
    frame.target.bind_sampled(frame.covered);
    draw_bodies(frame);
    frame.surroundings.fill_behind_ground(frame.target);
    frame.surroundings.fill_behind_bodies(frame.target);
    frame.target.resolve(frame.covered);
  }

  void set_up(const Stage& stage, const Shadow& shadow) const {
    lit_.use();
    lit_.set("to_light", stage.to_light);
    lit_.set("to_fill", stage.to_fill);
    lit_.set("light_texture", shadow.light_texture());
    lit_.set("shadow_offset", shadow_offset * static_cast<float>(stage.radius));
    lit_.set("shadow_blur", Eigen::Vector2f(Eigen::Vector2f::Constant(shadow_blur * Shadow::texel())));
    lit_.set("albedo_map", static_cast<int>(albedo_unit));
    lit_.set("shadow_map", static_cast<int>(shadow_unit));
  }

  void draw_bodies(const FrameParts& frame) const {
    lit_.use();
    lit_.set("view_projection", frame.stage.view_projection);
    lit_.set("eye", frame.stage.camera.eye);
    bind_texture(frame.gl(), shadow_unit, frame.shadow.depth_texture());
    for (std::size_t b = 0; b < albedos_.size(); ++b) {
      bind_texture(frame.gl(), albedo_unit, albedos_[b].texture.name());
      lit_.set("colour", albedos_[b].colour);
      frame.meshes[b].draw();
    }
  }

  Program lit_;
  std::vector<Albedo> albedos_;  // one per body
};

}  // namespace

std::unique_ptr<ViewPainter> make_textured_painter(const FrameParts& frame, const std::vector<DrawnBody>& bodies) {
  return std::make_unique<TexturedPainter>(frame, bodies);
}

}  // namespace billow::render
