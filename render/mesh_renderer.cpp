// A frame, pass by pass: shadows, bodies, ground, background, legend.
#include "render/mesh_renderer.h"

#include <stdexcept>
#include <utility>

#include "render/body_mesh.h"
#include "render/colour_map.h"
#include "render/frame_target.h"
#include "render/gl_context.h"
#include "render/legend.h"
#include "render/shaders.h"
#include "render/shadow.h"
#include "render/stage.h"

namespace billow::render {
namespace {

constexpr float kGroundExtent = 8.0f;                          // [radius] the ground fades out over this
const Eigen::Vector3f kShadowTint(0.40f, 0.42f, 0.46f);        // light left in full shadow, a little cool
const Eigen::Vector3f kVelocityBackdrop(0.82f, 0.82f, 0.82f);  // neutral, brighter than a cloth at rest
constexpr float kShadowOffset = 0.006f;                        // [radius]
constexpr float kShadowBlur = 2.5f;                            // [texel] of the depth map

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

GlObject make_ramp(const Gl& gl, const GlLimits& limits) {
  GlObject texture = make_colour_texture(gl, limits, ramp_image());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);  // a ramp has no place for mipmaps
  return texture;
}

std::string velocity_fragment(VelocityColour colour) {
  const bool components = colour == VelocityColour::components;
  return std::string(shaders::kVelocityFragment) + (components ? shaders::kComponentColour : shaders::kMagnitudeColour);
}

}  // namespace

struct MeshRenderer::Impl {
  Impl(const Settings& settings, const std::vector<DrawnBody>& bodies, const RunBounds& bounds, int threads);
  ~Impl() { context.make_current(); }

  void load(const std::vector<DrawnBody>& bodies);
  void set_up_programs() const;
  void update(const std::vector<sim::SurfaceState>& states);
  void draw_textured();
  void draw_velocity();
  void draw_ground() const;
  void draw_background(const Eigen::Vector3f& top, const Eigen::Vector3f& bottom) const;
  void bind_texture(GLenum unit, GLuint texture) const;

  Settings settings;
  double velocity_range;
  Stage stage;
  GlContext context;
  const Gl& gl;
  FrameTarget target;
  Shadow shadow;
  Program cloth, velocity, ground, background;
  GlObject no_vertices, ramp;
  std::vector<BodyMesh> meshes;
  std::vector<GlObject> textures;
  std::vector<Eigen::Vector3f> colours;
  Image legend;
};

MeshRenderer::Impl::Impl(const Settings& chosen, const std::vector<DrawnBody>& bodies, const RunBounds& bounds,
                         int threads)
    : settings(chosen),
      velocity_range(chosen.velocity_range.value_or(bounds.max_velocity)),
      stage(make_stage(chosen, bounds.box)),
      context(threads),
      gl(context.gl()),
      target(gl, context.limits(), chosen.width, chosen.height, chosen.samples),
      shadow(gl, stage),
      cloth(gl, "cloth", shaders::kSurfaceVertex, shaders::kClothFragment),
      velocity(gl, "velocity", shaders::kSurfaceVertex, velocity_fragment(chosen.velocity_colour)),
      ground(gl, "ground", shaders::kGroundVertex, shaders::kGroundFragment),
      background(gl, "background", shaders::kScreenVertex, shaders::kBackgroundFragment),
      no_vertices(make_vertex_array(gl)),
      ramp(make_ramp(gl, context.limits())),
      legend(draw_legend(chosen.velocity_colour, velocity_range, chosen.height)) {
  load(bodies);
  set_up_programs();
  gl.Enable(GL_FRAMEBUFFER_SRGB);
  gl.DepthFunc(GL_LEQUAL);  // the background lies exactly at the far plane
  check_gl(gl, "setting up");
}

void MeshRenderer::Impl::load(const std::vector<DrawnBody>& bodies) {
  for (const DrawnBody& body : bodies) {
    const bool plain = body.texture.pixels.empty();
    meshes.emplace_back(gl, body.surface);
    textures.push_back(make_colour_texture(gl, context.limits(), plain ? single_pixel() : body.texture));
    colours.push_back(plain ? body.colour : Eigen::Vector3f::Ones());
  }
}

void MeshRenderer::Impl::set_up_programs() const {
  const Eigen::Matrix4f view_projection = stage.view_projection.cast<float>();
  const Eigen::Vector3f eye = stage.camera.eye.cast<float>();
  const float radius = static_cast<float>(stage.radius);
  cloth.use();
  cloth.set("view_projection", view_projection);
  cloth.set("eye", eye);
  cloth.set("to_light", Eigen::Vector3f(stage.to_light.cast<float>()));
  cloth.set("light_texture", shadow.light_texture());
  cloth.set("shadow_offset", kShadowOffset * radius);
  cloth.set("shadow_blur", Eigen::Vector2f(Eigen::Vector2f::Constant(kShadowBlur * Shadow::texel())));
  cloth.set("albedo_map", 0);
  cloth.set("shadow_map", 1);
  velocity.use();
  velocity.set("view_projection", view_projection);
  velocity.set("eye", eye);
  velocity.set("velocity_range", static_cast<float>(velocity_range));
  velocity.set("shading", static_cast<float>(settings.velocity_shading));
  const GroundPatch& patch = stage.shadow_patch;
  ground.use();
  ground.set("view_projection", view_projection);
  ground.set("centre", Eigen::Vector3f(patch.centre.cast<float>()));
  ground.set("patch_u", Eigen::Vector3f((patch.half_u / patch.half_u.squaredNorm()).cast<float>()));
  ground.set("patch_v", Eigen::Vector3f((patch.half_v / patch.half_v.squaredNorm()).cast<float>()));
  ground.set("extent", kGroundExtent * radius);
  ground.set("top", settings.background.top);
  ground.set("bottom", settings.background.bottom);
  ground.set("floor_colour", settings.background.bottom);
  ground.set("frame_height", static_cast<float>(target.drawn_height()));
  ground.set("shadow_tint", kShadowTint);
}

void MeshRenderer::Impl::update(const std::vector<sim::SurfaceState>& states) {
  if (states.size() != meshes.size()) throw std::invalid_argument("draw() wants one state for each body");
  for (std::size_t b = 0; b < meshes.size(); ++b) meshes[b].update(states[b]);
}

void MeshRenderer::Impl::bind_texture(GLenum unit, GLuint texture) const {
  gl.ActiveTexture(GL_TEXTURE0 + unit);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.ActiveTexture(GL_TEXTURE0);
}

// Front to back, so that hidden ground and background cost nothing.
void MeshRenderer::Impl::draw_textured() {
  shadow.update(meshes);
  target.bind();
  gl.Enable(GL_DEPTH_TEST);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  cloth.use();
  bind_texture(1, shadow.depth_texture());
  for (std::size_t b = 0; b < meshes.size(); ++b) {
    bind_texture(0, textures[b].name());
    cloth.set("colour", colours[b]);
    meshes[b].draw();
  }
  if (settings.ground) draw_ground();
  draw_background(settings.background.top, settings.background.bottom);
}

void MeshRenderer::Impl::draw_velocity() {
  target.bind();
  gl.Enable(GL_DEPTH_TEST);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  velocity.use();
  bind_texture(0, ramp.name());
  for (const BodyMesh& mesh : meshes) mesh.draw();
  draw_background(kVelocityBackdrop, kVelocityBackdrop);
}

void MeshRenderer::Impl::draw_ground() const {
  ground.use();
  bind_texture(0, shadow.ground_texture());
  gl.BindVertexArray(no_vertices.name());
  gl.Enable(GL_CULL_FACE);  // from below there is no ground
  gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  gl.Disable(GL_CULL_FACE);
}

void MeshRenderer::Impl::draw_background(const Eigen::Vector3f& top, const Eigen::Vector3f& bottom) const {
  background.use();
  background.set("top", top);
  background.set("bottom", bottom);
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
