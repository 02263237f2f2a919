// The light that a body's surface throws back: its textures in GL.
#pragma once

#include <vector>

#include "render/frame/body_mesh.h"
#include "render/frame/drawn_body.h"
#include "render/gl/gl_objects.h"

namespace billow::render {

/// One finish of one body, and the triangles that have it.
struct Albedo {
  std::size_t body;
  TriangleRange triangles;
  GlObject texture;
  Eigen::Vector3f colour;  // linear-light RGB, times the texture
  float opacity;           // times the texture's alpha
  AlphaMode alpha;
  float cutoff, hole_below;  // alpha: of cut_out; below which nothing is there
  bool scenery;              // as the body's

  bool has_holes() const { return hole_below > 0.0f; }
};

/// The finishes of all bodies, in order; none that no triangle has.
std::vector<Albedo> make_albedos(const Gl& gl, const std::vector<DrawnBody>& bodies);

}  // namespace billow::render
