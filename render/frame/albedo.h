// The light that a body's surface throws back: its texture in GL.
#pragma once

#include "render/frame/drawn_body.h"
#include "render/gl/gl_objects.h"

namespace billow::render {

/// The texture times the colour.
struct Albedo {
  GlObject texture;
  Eigen::Vector3f colour;  // linear-light RGB
};

Albedo make_albedo(const Gl& gl, const DrawnBody& body);

}  // namespace billow::render
