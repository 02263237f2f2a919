// The key light's shadows: a depth map for the bodies, and from it a soft shadow on the ground.
#pragma once

#include <vector>

#include "render/frame/body_programs.h"
#include "render/frame/stage.h"
#include "render/gl/gl_objects.h"

namespace billow::render {

class Shadow {
 public:
  /// `albedos` are those of the bodies that it will draw, and outlive it.
  Shadow(const Gl& gl, const Stage& stage, const std::vector<Albedo>& albedos);

  /// Draws both maps for the meshes as they are now, without what their finishes cut out.
  void update(const std::vector<BodyMesh>& meshes);

  /// Depth as seen from the light, set up for comparison (sampler2DShadow).
  GLuint depth_texture() const { return depth_.name(); }
  /// Share of the key light missing over the stage's shadow patch, in [0, 1]; 0 at its border.
  GLuint ground_texture() const { return ground_.name(); }
  /// World -> (u, v, depth) in the depth map, each in [0, 1] inside it.
  const Eigen::Matrix4f& light_texture() const { return light_texture_; }
  /// [texture] size of a texel of the depth map.
  static float texel();

 private:
  void draw_depth(const std::vector<BodyMesh>& meshes) const;
  void draw_ground() const;

  const Gl* gl_;
  const std::vector<Albedo>& albedos_;
  BodyPrograms depth_programs_;
  Program occlusion_program_, blur_program_;
  GlObject depth_, noisy_ground_, ground_;
  GlObject depth_target_, noisy_target_, ground_target_;
  GlObject no_vertices_;
  Eigen::Matrix4f light_texture_;
};

}  // namespace billow::render
