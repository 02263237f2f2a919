// Shadow passes.
#include "render/frame/shadow.h"

#include "render/frame/shaders.h"

namespace billow::render {
namespace {

constexpr int depth_map_size = 512;   // [texel] each way
constexpr int ground_map_size = 144;  // [texel] each way; the ground's shadow is soft

GlObject make_target(const Gl& gl, GLenum attachment, const GlObject& texture) {
  GlObject target = make_framebuffer(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.name());
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture.name(), 0);
  if (attachment == GL_DEPTH_ATTACHMENT) {
    gl.DrawBuffer(GL_NONE);
    gl.ReadBuffer(GL_NONE);
  }
  return target;
}

// Beyond the map nothing blocks the light.
GlObject make_depth_map(const Gl& gl) {
  GlObject texture = make_plain_texture(gl, GL_DEPTH_COMPONENT24, depth_map_size, depth_map_size, GL_LINEAR);
  const float far[] = {1.0f, 1.0f, 1.0f, 1.0f};
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  gl.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, far);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  return texture;
}

Eigen::Matrix4f texture_matrix(const Eigen::Matrix4d& clip) {
  Eigen::Matrix4d half = 0.5 * Eigen::Matrix4d::Identity();
  half.topRightCorner<3, 1>().setConstant(0.5);
  half(3, 3) = 1.0;
  return (half * clip).cast<float>();
}

// (s, t, 0, 1) -> a point on the ground.
Eigen::Matrix4f patch_matrix(const GroundPatch& patch) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 1>() = patch.half_u;
  matrix.block<3, 1>(0, 1) = patch.half_v;
  matrix.topRightCorner<3, 1>() = patch.centre;
  return matrix.cast<float>();
}

}  // namespace

Shadow::Shadow(const Gl& gl, const Stage& stage, const std::vector<Albedo>& albedos)
    : gl_(&gl),
      albedos_(albedos),
      depth_programs_(gl, "depth", shaders::depth_vertex, shaders::depth_fragment, albedos),
      occlusion_program_(gl, "occlusion", shaders::screen_vertex, shaders::occlusion_fragment),
      blur_program_(gl, "blur", shaders::screen_vertex, shaders::blur_fragment),
      depth_(make_depth_map(gl)),
      noisy_ground_(make_plain_texture(gl, GL_R8, ground_map_size, ground_map_size, GL_LINEAR)),
      ground_(make_plain_texture(gl, GL_R8, ground_map_size, ground_map_size, GL_LINEAR)),
      depth_target_(make_target(gl, GL_DEPTH_ATTACHMENT, depth_)),
      noisy_target_(make_target(gl, GL_COLOR_ATTACHMENT0, noisy_ground_)),
      ground_target_(make_target(gl, GL_COLOR_ATTACHMENT0, ground_)),
      no_vertices_(make_vertex_array(gl)),
      light_texture_(texture_matrix(stage.light_projection)) {
  depth_programs_.set_up([&](const Program& program) { program.set("light_projection", stage.light_projection); });
  occlusion_program_.use();
  occlusion_program_.set("patch_to_light", Eigen::Matrix4f(light_texture_ * patch_matrix(stage.shadow_patch)));
  occlusion_program_.set("light_size", stage.light_size);
  occlusion_program_.set("spread", static_cast<float>(light_spread));
  blur_program_.use();
  blur_program_.set("texel", Eigen::Vector2f(Eigen::Vector2f::Constant(1.0f / ground_map_size)));
}

float Shadow::texel() { return 1.0f / depth_map_size; }

void Shadow::update(const std::vector<BodyMesh>& meshes) {
  draw_depth(meshes);
  draw_ground();
}

void Shadow::draw_depth(const std::vector<BodyMesh>& meshes) const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, depth_target_.name());
  gl_->Viewport(0, 0, depth_map_size, depth_map_size);
  gl_->Enable(GL_DEPTH_TEST);
  gl_->Clear(GL_DEPTH_BUFFER_BIT);
  gl_->Enable(GL_POLYGON_OFFSET_FILL);  // pushes steep triangles back by their own slope
  gl_->PolygonOffset(1.5f, 2.0f);
  for (const Albedo& albedo : albedos_) {
    depth_programs_.use_for(albedo, 0);
    meshes[albedo.body].draw(albedo.triangles);
  }
  gl_->Disable(GL_POLYGON_OFFSET_FILL);
}

void Shadow::draw_ground() const {
  gl_->Viewport(0, 0, ground_map_size, ground_map_size);
  gl_->Disable(GL_DEPTH_TEST);
  gl_->BindVertexArray(no_vertices_.name());
  gl_->BindFramebuffer(GL_FRAMEBUFFER, noisy_target_.name());
  occlusion_program_.use();
  gl_->BindTexture(GL_TEXTURE_2D, depth_.name());
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_NONE);  // this pass wants the depths themselves
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, ground_target_.name());
  blur_program_.use();
  gl_->BindTexture(GL_TEXTURE_2D, noisy_ground_.name());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace billow::render
