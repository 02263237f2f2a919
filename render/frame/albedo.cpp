// Textures of bodies.
#include "render/frame/albedo.h"

namespace billow::render {
namespace {

Image single_pixel() {
  Image image(1, 1, 3);
  image.pixels = {255, 255, 255};
  return image;
}

// A texture that covers the body once must not bleed from one edge into the opposite one; a tiled one must.
GLint wrap_for(const sim::Surface& surface) {
  const bool once = surface.uv.size() == 0 || (surface.uv.minCoeff() >= 0.0f && surface.uv.maxCoeff() <= 1.0f);
  return once ? GL_CLAMP_TO_EDGE : GL_REPEAT;
}

}  // namespace

Albedo make_albedo(const Gl& gl, const DrawnBody& body) {
  const bool plain = body.texture.pixels.empty();
  return {make_colour_texture(gl, plain ? single_pixel() : body.texture, wrap_for(body.surface)),
          plain ? body.colour : Eigen::Vector3f::Ones()};
}

}  // namespace billow::render
