// What a frame is drawn into: multisampled sRGB pixels, resolved and read back.
#pragma once

#include "render/gl_objects.h"
#include "render/image.h"

namespace billow::render {

/// A multisampled framebuffer of width x height pixels; samples beyond what GL offers come from drawing at twice the
/// size each way. All averaging happens in linear light.
class FrameTarget {
 public:
  /// samples: 1, 2, 4, 8 or 16. Throws InputError when GL cannot hold the size.
  FrameTarget(const Gl& gl, const GlLimits& limits, int width, int height, int samples);

  /// Directs drawing here, over the whole area.
  void bind() const;
  /// [pixel] of the area that is drawn to: the picture's size or twice it.
  int drawn_width() const { return width_ * scale_; }
  int drawn_height() const { return height_ * scale_; }
  /// Resolves and reads what was drawn: RGB.
  Image read();

 private:
  void blit(const GlObject& from, const GlObject& to, int to_width, int to_height, GLenum filter) const;

  const Gl* gl_;
  int width_, height_, scale_;
  GlObject sampled_colour_, sampled_depth_, sampled_;
  GlObject resolved_colour_, resolved_;
  GlObject reduced_colour_, reduced_;
  std::vector<std::uint8_t> rgba_;
};

}  // namespace billow::render
