// A frame from the bodies' states to the image: the table of views says who draws it.
#include "render/frame/mesh_renderer.h"

#include <map>

#include "render/frame/frame_parts.h"
#include "render/frame/view_drawing.h"
#include "render/paper/legend.h"

namespace billow::render {

struct MeshRenderer::Impl {
  Impl(const Settings& settings, const std::vector<DrawnBody>& bodies, const RunBounds& bounds, int threads);
  ~Impl() { parts.context.make_current(); }

  FrameParts parts;
  std::map<View, std::unique_ptr<ViewPainter>> painters;
  Image legend;
};

MeshRenderer::Impl::Impl(const Settings& settings, const std::vector<DrawnBody>& bodies, const RunBounds& bounds,
                         int threads)
    : parts(settings, bodies, bounds, threads),
      legend(draw_legend(settings.velocity_colour, parts.velocity_range, settings.height)) {
  for (const ViewDrawing& drawing : view_drawings()) painters[drawing.view] = drawing.make(parts, bodies);
  check_gl(parts.gl(), "setting up");
}

MeshRenderer::MeshRenderer(const Settings& settings, std::vector<DrawnBody> bodies, const RunBounds& bounds,
                           int threads)
    : impl_(std::make_unique<Impl>(settings, bodies, bounds, threads)) {}

MeshRenderer::~MeshRenderer() = default;

Image MeshRenderer::draw(View view, const std::vector<sim::SurfaceState>& bodies) {
  FrameParts& parts = impl_->parts;
  const ViewDrawing& drawing = drawing_of(view);
  parts.context.make_current();
  parts.update(bodies);
  impl_->painters.at(view)->draw(parts);
  Image frame = parts.target.read();
  check_gl(parts.gl(), "drawing a frame");
  if (drawing.legend && parts.settings.legend) add_legend(frame, impl_->legend);
  return frame;
}

double MeshRenderer::velocity_range() const { return impl_->parts.velocity_range; }

std::string MeshRenderer::description() const { return impl_->parts.context.description(); }

}  // namespace billow::render
