// A body's triangles in GL: static topology and texture coordinates, positions and velocities of the frame.
#pragma once

#include <vector>

#include "render/gl/gl_objects.h"
#include "sim/drawn/surface.h"

namespace billow::render {

/// Some of a surface's triangles, one after the other.
struct TriangleRange {
  int first = 0, count = 0;
};

/// The triangles of one of the surface's materials.
TriangleRange triangles_of(const sim::Surface& surface, int material);

/// Vertex attributes: 0 position [m], 1 normal, 2 velocity [m/s], 3 texture coordinates, 4 colour (linear light).
class BodyMesh {
 public:
  BodyMesh(const Gl& gl, const sim::Surface& surface);

  /// Uploads the frame's positions and velocities and the normals that follow. Throws std::invalid_argument when
  /// `state` does not have the surface's points.
  void update(const sim::SurfaceState& state);
  void draw() const;
  void draw(const TriangleRange& triangles) const;
  /// Triangles of `count` corners in any order, by way of `buffer`.
  void draw_corners(const GlObject& buffer, const GLuint* corner, std::size_t count) const;

  /// A corner as it is now.
  struct Corner {
    float position[3], normal[3], velocity[3], strain;
  };
  const sim::Surface& surface() const { return surface_; }
  const std::vector<Corner>& corners() const { return corner_; }

 private:
  void describe_moving() const;

  const Gl* gl_;
  sim::Surface surface_;
  std::vector<Corner> corner_;
  GlObject array_, moving_, fixed_, colour_, index_;
};

}  // namespace billow::render
