// The textured view: lit bodies with their textures, and their shadows on the ground.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "render/frame/blended_triangles.h"
#include "render/frame/shaders.h"
#include "render/frame/view_drawing.h"

namespace billow::render {
namespace {

constexpr float shadow_offset = 0.009f;  // [radius]
constexpr float shadow_blur = 4.5f;      // [texel] of the depth map
constexpr GLenum albedo_unit = 0, shadow_unit = 1;

class TexturedPainter : public ViewPainter {
 public:
  explicit TexturedPainter(const FrameParts& frame)
      : lit_(frame.gl(), "lit", shaders::surface_vertex, shaders::lit_fragment) {
    set_up(lit_, frame.stage, frame.shadow);
    cut_out_ = make_where_needed(frame, AlphaMode::cut_out, "CUT_OUT");
    blend_ = make_where_needed(frame, AlphaMode::blend, "BLEND");
    if (blend_) seen_through_.emplace(frame.gl());
  }

  Picture draw(FrameParts& frame) const override {
    frame.shadow.update(frame.meshes);
    return frame.draw_tiles(frame.settings.background.none, [&](const PixelBox& covered) { paint(frame, covered); });
  }

 private:
  void paint(FrameParts& frame, const PixelBox& covered) const {
    frame.recall_backdrop();
    frame.surroundings.draw_shade(frame.target, frame.shadow.ground_texture());
    if (covered.empty()) return;
    frame.target.bind_sampled(covered);
    draw_solid(frame, lit_, AlphaMode::opaque);
    if (cut_out_) draw_cut_out(frame);
    frame.surroundings.fill_behind_ground(frame.target);
    frame.surroundings.fill_behind_bodies(frame.target);
    if (blend_) draw_blended(frame);
    frame.target.resolve(covered);
  }

  static void set_up(const Program& program, const Stage& stage, const Shadow& shadow) {
    program.use();
    program.set("to_light", stage.to_light);
    program.set("to_fill", stage.to_fill);
    program.set("light_texture", shadow.light_texture());
    program.set("shadow_offset", shadow_offset * static_cast<float>(stage.radius));
    program.set("shadow_blur", Eigen::Vector2f(Eigen::Vector2f::Constant(shadow_blur * Shadow::texel())));
    program.set("albedo_map", static_cast<int>(albedo_unit));
    program.set("shadow_map", static_cast<int>(shadow_unit));
  }

  static std::optional<Program> make_where_needed(const FrameParts& frame, AlphaMode alpha, const char* define) {
    const auto needs = [&](const Albedo& albedo) { return albedo.alpha == alpha; };
    if (std::none_of(frame.albedos.begin(), frame.albedos.end(), needs)) return std::nullopt;
    Program program(frame.gl(), std::string("lit ") + define, shaders::surface_vertex,
                    shaders::headed(shaders::lit_fragment, fmt::format("#define {}\n", define)));
    set_up(program, frame.stage, frame.shadow);
    return program;
  }

  static void use(const FrameParts& frame, const Program& program) {
    program.use();
    program.set("view_projection", frame.stage.view_projection);
    program.set("eye", frame.stage.camera.eye);
    bind_texture(frame.gl(), shadow_unit, frame.shadow.depth_texture());
  }

  static void set_finish(const FrameParts& frame, const Program& program, const Albedo& albedo) {
    bind_texture(frame.gl(), albedo_unit, albedo.texture.name());
    program.set("colour", albedo.colour);
    if (albedo.alpha == AlphaMode::opaque) return;
    program.set("opacity", albedo.opacity);
    program.set("cutoff", albedo.cutoff);
  }

  static void draw_solid(const FrameParts& frame, const Program& program, AlphaMode alpha) {
    use(frame, program);
    for (const Albedo& albedo : frame.albedos) {
      if (albedo.alpha != alpha) continue;
      set_finish(frame, program, albedo);
      frame.meshes[albedo.body].draw(albedo.triangles);
    }
  }

  // The share of a pixel that a cut edge leaves becomes a share of its samples, which are opaque.
  void draw_cut_out(const FrameParts& frame) const {
    const Gl& gl = frame.gl();
    gl.Enable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    gl.Enable(GL_SAMPLE_ALPHA_TO_ONE);
    draw_solid(frame, *cut_out_, AlphaMode::cut_out);
    gl.Disable(GL_SAMPLE_ALPHA_TO_ONE);
    gl.Disable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  }

  // Over everything else, the farthest triangle first. The pixels hold colour times alpha.
  void draw_blended(const FrameParts& frame) const {
    const Gl& gl = frame.gl();
    gl.Enable(GL_BLEND);
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl.DepthMask(GL_FALSE);
    use(frame, *blend_);
    seen_through_->draw(frame, [&](const Albedo& albedo) { set_finish(frame, *blend_, albedo); });
    gl.DepthMask(GL_TRUE);
    gl.Disable(GL_BLEND);
  }

  Program lit_;
  std::optional<Program> cut_out_, blend_;
  std::optional<BlendedTriangles> seen_through_;
};

}  // namespace

std::unique_ptr<ViewPainter> make_textured_painter(const FrameParts& frame, const std::vector<DrawnBody>&) {
  return std::make_unique<TexturedPainter>(frame);
}

}  // namespace billow::render
