// Vertices -> corners, sRGB -> linear light.
#include "cli/drawn/painted_surface.h"

#include "base/srgb.h"

namespace billow::cli {

sim::Surface painted(sim::Surface surface, const sim::Mesh& mesh, const Look& look) {
  if (!look.shows_vertex_colours) return surface;
  surface.colour = mesh.colour(surface.point, Eigen::all);
  if (!mesh.linear_colour)
    surface.colour = surface.colour.unaryExpr([](float c) { return static_cast<float>(srgb_to_linear(c)); });
  return surface;
}

}  // namespace billow::cli
