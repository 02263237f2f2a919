// All that is not a body: the background, the ground, and the shadow on it.
#pragma once

#include "render/frame/stage.h"
#include "render/gl/frame_target.h"
#include "render/gl/gl_objects.h"
#include "render/image/settings.h"

namespace billow::render {

class Surroundings {
 public:
  /// The background, and a ground that fades into it.
  Surroundings(const Gl& gl, const Settings& settings, const Stage& stage, int drawn_height);

  /// The stage's camera has moved.
  void see_from(const Stage& stage) const;
  /// Draws the tile's background and ground without shadows, which are the same in every frame, and keeps them as the
  /// backdrop.
  void draw_backdrop(const FrameTarget& target) const;
  /// Darkens the ground of the plain picture by the shadow on the stage's patch.
  void draw_shade(const FrameTarget& target, GLuint shadow) const;
  /// Gives the multisampled pixels the plain picture wherever the ground hides a body.
  void fill_behind_ground(const FrameTarget& target) const;
  /// Gives them the plain picture wherever no body is.
  void fill_behind_bodies(const FrameTarget& target) const;

 private:
  void draw_ground_square() const;
  void draw_screen() const;

  const Gl* gl_;
  bool has_background_, has_ground_, has_shade_;
  Program background_, ground_, shade_, copy_, copy_ground_;
  GlObject no_vertices_;
};

}  // namespace billow::render
