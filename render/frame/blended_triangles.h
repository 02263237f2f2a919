// Triangles that show what is behind them.
#pragma once

#include <functional>
#include <vector>

#include "render/frame/frame_parts.h"

namespace billow::render {

/// Draws the triangles of all blended finishes, the farthest first: by the distance of their middles along the camera's
/// axis, those at the same distance in the order of bodies and triangles.
class BlendedTriangles {
 public:
  explicit BlendedTriangles(const Gl& gl) : index_(make_buffer(gl)) {}

  /// `set_finish` is called whenever the next triangles have another finish.
  void draw(const FrameParts& frame, const std::function<void(const Albedo&)>& set_finish) const;

 private:
  GlObject index_;
};

}  // namespace billow::render
