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

std::vector<Albedo> make_albedos(const Gl& gl, const std::vector<DrawnBody>& bodies) {
  std::vector<Albedo> albedos;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const DrawnBody& body = bodies[b];
    for (std::size_t m = 0; m < body.finish.size(); ++m) {
      const TriangleRange triangles = triangles_of(body.surface, static_cast<int>(m));
      if (triangles.count == 0) continue;
      const Finish& finish = body.finish[m];
      const bool plain = finish.texture.pixels.empty();
      albedos.push_back(
          {b, triangles, make_colour_texture(gl, plain ? single_pixel() : finish.texture, wrap_for(body.surface)),
           finish.colour, finish.opacity, finish.alpha, finish.cutoff, finish.hole_below(), body.scenery});
    }
  }
  return albedos;
}

}  // namespace billow::render
