// What a frame is drawn into: a plain sRGB picture, and beside it multisampled pixels for the parts that have edges.
#pragma once

#include <vector>

#include "render/gl/gl_objects.h"
#include "render/gl/pixel_box.h"
#include "render/gl/tile_limits.h"
#include "render/image/image.h"

namespace billow::render {

/// Pictures of width x height pixels. Backgrounds and shadows are smooth and go straight into the plain picture; bodies
/// are drawn multisampled, inside a box, and then resolved onto it. Samples beyond what GL offers come from drawing
/// everything at twice the size each way. All averaging happens in linear light. Boxes are of the drawn area.
class FrameTarget {
 public:
  /// samples: 1, 2, 4, 8 or 16. Throws InputError when GL cannot draw the size.
  FrameTarget(const Gl& gl, const GlLimits& limits, int width, int height, int samples, const TileLimits& tiles);

  /// [pixel] of the area that is drawn to: the picture's size or twice it.
  int drawn_width() const { return width_ * scale_; }
  int drawn_height() const { return height_ * scale_; }

  /// The parts of that area that are drawn one after the other; of most pictures there is one.
  const std::vector<PixelBox>& tiles() const { return tiles_; }
  /// From now on `tile`, one of those, is drawn; what is outside of it is not.
  void turn_to(const PixelBox& tile) { tile_ = tile; }
  const PixelBox& tile() const { return tile_; }

  /// Directs drawing to the plain picture.
  void bind_plain() const;
  /// Keeps the plain picture as it is now; recall_backdrop() brings it back.
  void keep_backdrop() const { copy(plain_, backdrop_); }
  void recall_backdrop() const { copy(backdrop_, plain_); }
  /// Directs drawing to the multisampled pixels of `box`, which lies in the tile, their depth cleared.
  void bind_sampled(const PixelBox& box) const;
  /// Puts the multisampled pixels of `box` onto the plain picture.
  void resolve(const PixelBox& box) const;
  /// The plain picture, to draw with.
  GLuint plain_texture() const { return plain_colour_.name(); }

  /// Puts the tile of the plain picture, at the picture's size, into `picture`: RGB, or with what it covers as straight
  /// alpha, RGBA, by the channels that it has.
  void read_into(Image& picture);

 private:
  void copy(const GlObject& from, const GlObject& to) const;
  void set_viewport() const;

  const Gl* gl_;
  int width_, height_, scale_;
  std::vector<PixelBox> tiles_;
  PixelBox tile_;
  GlObject plain_colour_, backdrop_colour_, reduced_colour_, sampled_colour_, sampled_depth_;
  GlObject plain_, backdrop_, reduced_, sampled_;
  std::vector<std::uint8_t> rgba_;
};

}  // namespace billow::render
