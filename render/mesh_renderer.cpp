// A frame, pass by pass: shadows, bodies, ground, background, legend.
#include "render/mesh_renderer.h"

#include <stdexcept>
#include <utility>

#include "render/body_mesh.h"
#include "render/colour_map.h"
#include "render/frame_target.h"
#include "render/gl_context.h"
#include "render/legend.h"
#include "render/pixel_box.h"
#include "render/shaders.h"
#include "render/shadow.h"
#include "render/stage.h"

namespace billow::render {
namespace {

constexpr float kGroundExtent = 8.0f;                    // [radius] the ground fades out over this
const Eigen::Vector3f kShadowTint(0.44f, 0.46f, 0.50f);  // light left in full shadow, a little cool
constexpr float kVelocityBackdrop = 0.82f;               // linear light: neutral, brighter than a cloth at rest
constexpr float kShadowOffset = 0.009f;                  // [radius]
constexpr float kShadowBlur = 4.5f;                      // [texel] of the depth map

Image single_pixel() {
  Image image(1, 1, 3);
  image.pixels = {255, 255, 255};
  return image;
}

Image ramp_image() {
  Image image(256, 1, 3);
  for (int x = 0; x < image.width; ++x) {
    const Rgb8 colour = magnitude_rgb(x / 255.0);
    std::copy(colour.begin(), colour.end(), image.row(0) + 3 * x);
  }
  return image;
}

// A texture that covers the body once must not bleed from one edge into the opposite one; a tiled one must.
GLint wrap_for(const sim::Surface& surface) {
  const bool once = surface.uv.size() == 0 || (surface.uv.minCoeff() >= 0.0f && surface.uv.maxCoeff() <= 1.0f);
  return once ? GL_CLAMP_TO_EDGE : GL_REPEAT;
}

GlObject make_ramp(const Gl& gl) {
  GlObject texture = make_colour_texture(gl, ramp_image(), GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);  // a ramp has no place for mipmaps
  return texture;
}

std::string velocity_fragment(VelocityColour colour) {
  const bool components = colour == VelocityColour::components;
  return std::string(shaders::kVelocityFragment) + (components ? shaders::kComponentColour : shaders::kMagnitudeColour);
}

std::string with_gradient(const char* fragment) { return std::string(fragment) + shaders::kGradient; }

Eigen::Matrix4f single(const Eigen::Matrix4d& matrix) { return matrix.cast<float>(); }
Eigen::Vector3f single(const Eigen::Vector3d& vector) { return vector.cast<float>(); }

GroundPatch ground_square(const Eigen::Vector3d& centre, double half_side) {
  return {centre, half_side * Eigen::Vector3d::UnitZ(), half_side * Eigen::Vector3d::UnitX()};
}

void set_square(const Program& program, const Stage& stage, const GroundPatch& square) {
  program.use();
  program.set("view_projection", single(stage.view_projection));
  program.set("centre", single(square.centre));
  program.set("half_u", single(square.half_u));
  program.set("half_v", single(square.half_v));
}

}  // namespace

struct MeshRenderer::Impl {
  Impl(const Settings& settings, const std::vector<DrawnBody>& bodies, const RunBounds& bounds, int threads);
  ~Impl() { context.make_current(); }

  void load(const std::vector<DrawnBody>& bodies);
  void set_up_bodies() const;
  void set_up_ground() const;
  void draw_backdrop() const;
  void update(const std::vector<sim::SurfaceState>& states);
  void draw_textured();
  void draw_velocity();
  void draw_shade() const;
  void fill_behind_bodies(bool behind_ground) const;
  void draw_ground_square() const;
  void draw_screen() const;
  void bind_texture(GLenum unit, GLuint texture) const;

  Settings settings;
  double velocity_range;
  Stage stage;
  GlContext context;
  const Gl& gl;
  FrameTarget target;
  Shadow shadow;
  Program cloth, velocity, background, ground, shade, copy, copy_ground;
  GlObject no_vertices, ramp;
  std::vector<BodyMesh> meshes;
  std::vector<GlObject> textures;
  std::vector<Eigen::Vector3f> colours;
  Image legend;
  PixelBox covered;  // by the bodies of the current frame
};

MeshRenderer::Impl::Impl(const Settings& chosen, const std::vector<DrawnBody>& bodies, const RunBounds& bounds,
                         int threads)
    : settings(chosen),
      velocity_range(chosen.velocity_range.value_or(bounds.velocity_scale)),
      stage(make_stage(chosen, bounds.box)),
      context(threads),
      gl(context.gl()),
      target(gl, context.limits(), chosen.width, chosen.height, chosen.samples),
      shadow(gl, stage),
      cloth(gl, "cloth", shaders::kSurfaceVertex, shaders::kClothFragment),
      velocity(gl, "velocity", shaders::kSurfaceVertex, velocity_fragment(chosen.velocity_colour)),
      background(gl, "background", shaders::kScreenVertex, with_gradient(shaders::kBackgroundFragment)),
      ground(gl, "ground", shaders::kGroundVertex, with_gradient(shaders::kGroundFragment)),
      shade(gl, "shade", shaders::kGroundVertex, shaders::kShadeFragment),
      copy(gl, "copy", shaders::kScreenVertex, shaders::kCopyFragment),
      copy_ground(gl, "copy ground", shaders::kGroundVertex, shaders::kCopyFragment),
      no_vertices(make_vertex_array(gl)),
      ramp(make_ramp(gl)),
      legend(draw_legend(chosen.velocity_colour, velocity_range, chosen.height)) {
  load(bodies);
  gl.Enable(GL_FRAMEBUFFER_SRGB);
  gl.DepthFunc(GL_LEQUAL);  // what fills the screen lies exactly at the far plane
  gl.BlendFunc(GL_DST_COLOR, GL_ZERO);
  set_up_bodies();
  set_up_ground();
  draw_backdrop();
  check_gl(gl, "setting up");
}

void MeshRenderer::Impl::load(const std::vector<DrawnBody>& bodies) {
  for (const DrawnBody& body : bodies) {
    const bool plain = body.texture.pixels.empty();
    meshes.emplace_back(gl, body.surface);
    textures.push_back(make_colour_texture(gl, plain ? single_pixel() : body.texture, wrap_for(body.surface)));
    colours.push_back(plain ? body.colour : Eigen::Vector3f::Ones());
  }
}

void MeshRenderer::Impl::set_up_bodies() const {
  cloth.use();
  cloth.set("view_projection", single(stage.view_projection));
  cloth.set("eye", single(stage.camera.eye));
  cloth.set("to_light", single(stage.to_light));
  cloth.set("to_fill", single(stage.to_fill));
  cloth.set("light_texture", shadow.light_texture());
  cloth.set("shadow_offset", kShadowOffset * static_cast<float>(stage.radius));
  cloth.set("shadow_blur", Eigen::Vector2f(Eigen::Vector2f::Constant(kShadowBlur * Shadow::texel())));
  cloth.set("albedo_map", 0);
  cloth.set("shadow_map", 1);
  velocity.use();
  velocity.set("view_projection", single(stage.view_projection));
  velocity.set("eye", single(stage.camera.eye));
  velocity.set("velocity_range", static_cast<float>(velocity_range));
  velocity.set("shading", static_cast<float>(settings.velocity_shading));
}

void MeshRenderer::Impl::set_up_ground() const {
  const GroundPatch wide = ground_square(stage.shadow_patch.centre, kGroundExtent * stage.radius);
  set_square(ground, stage, wide);
  set_square(copy_ground, stage, wide);
  set_square(shade, stage, stage.shadow_patch);
  shade.set("shadow_tint", kShadowTint);
  for (const Program* program : {&background, &ground}) {
    program->use();
    program->set("top", settings.background.top);
    program->set("bottom", settings.background.bottom);
    program->set("frame_height", static_cast<float>(target.drawn_height()));
  }
  ground.set("floor_colour", settings.background.bottom);
}

// Background and ground without shadows are the same in every frame.
void MeshRenderer::Impl::draw_backdrop() const {
  target.bind_plain();
  background.use();
  draw_screen();
  if (settings.ground) {
    ground.use();
    draw_ground_square();
  }
  target.keep_backdrop();
}

void MeshRenderer::Impl::update(const std::vector<sim::SurfaceState>& states) {
  if (states.size() != meshes.size()) throw std::invalid_argument("draw() wants one state for each body");
  covered = {};
  for (std::size_t b = 0; b < meshes.size(); ++b) {
    meshes[b].update(states[b]);
    covered = joined(covered, covered_pixels(states[b].position, single(stage.view_projection), target.drawn_width(),
                                             target.drawn_height()));
  }
}

void MeshRenderer::Impl::bind_texture(GLenum unit, GLuint texture) const {
  gl.ActiveTexture(GL_TEXTURE0 + unit);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.ActiveTexture(GL_TEXTURE0);
}

void MeshRenderer::Impl::draw_textured() {
  target.recall_backdrop();
  shadow.update(meshes);
  if (settings.ground) draw_shade();
  if (covered.empty()) return;
  target.bind_sampled(covered);
  cloth.use();
  bind_texture(1, shadow.depth_texture());
  for (std::size_t b = 0; b < meshes.size(); ++b) {
    bind_texture(0, textures[b].name());
    cloth.set("colour", colours[b]);
    meshes[b].draw();
  }
  fill_behind_bodies(settings.ground);
  target.resolve(covered);
}

void MeshRenderer::Impl::draw_velocity() {
  target.bind_plain();
  gl.ClearColor(kVelocityBackdrop, kVelocityBackdrop, kVelocityBackdrop, 1.0f);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  if (covered.empty()) return;
  target.bind_sampled(covered);
  velocity.use();
  bind_texture(0, ramp.name());
  for (const BodyMesh& mesh : meshes) mesh.draw();
  fill_behind_bodies(false);
  target.resolve(covered);
}

// The shadow multiplies the ground that is already there.
void MeshRenderer::Impl::draw_shade() const {
  target.bind_plain();
  shade.use();
  bind_texture(0, shadow.ground_texture());
  gl.Enable(GL_BLEND);
  draw_ground_square();
  gl.Disable(GL_BLEND);
}

// Samples that no body took, and those where the ground hides one, show the plain picture.
void MeshRenderer::Impl::fill_behind_bodies(bool behind_ground) const {
  bind_texture(0, target.plain_texture());
  if (behind_ground) {
    copy_ground.use();
    draw_ground_square();
  }
  copy.use();
  draw_screen();
}

void MeshRenderer::Impl::draw_ground_square() const {
  gl.BindVertexArray(no_vertices.name());
  gl.Enable(GL_CULL_FACE);  // from below there is no ground
  gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  gl.Disable(GL_CULL_FACE);
}

void MeshRenderer::Impl::draw_screen() const {
  gl.BindVertexArray(no_vertices.name());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

MeshRenderer::MeshRenderer(const Settings& settings, std::vector<DrawnBody> bodies, const RunBounds& bounds,
                           int threads)
    : impl_(std::make_unique<Impl>(settings, bodies, bounds, threads)) {}

MeshRenderer::~MeshRenderer() = default;

Image MeshRenderer::draw(View view, const std::vector<sim::SurfaceState>& bodies) {
  impl_->context.make_current();
  impl_->update(bodies);
  view == View::textured ? impl_->draw_textured() : impl_->draw_velocity();
  Image frame = impl_->target.read();
  check_gl(impl_->gl, "drawing a frame");
  if (view == View::velocity && impl_->settings.legend) add_legend(frame, impl_->legend);
  return frame;
}

double MeshRenderer::velocity_range() const { return impl_->velocity_range; }

std::string MeshRenderer::description() const { return impl_->context.description(); }

}  // namespace billow::render
