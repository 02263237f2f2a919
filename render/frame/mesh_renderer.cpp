// A frame from the bodies' states to the image: the table of views says who draws it.
#include "render/frame/mesh_renderer.h"

#include <map>

#include "render/frame/frame_parts.h"
#include "render/frame/view_drawing.h"
#include "render/paper/legend.h"

namespace billow::render {

struct MeshRenderer::Impl {
  Impl(const Settings& settings, const std::vector<DrawnBody>& bodies, const RunBounds& bounds,
       const DrawingOptions& options);
  ~Impl() { parts.context.make_current(); }

  const ViewPainter& painter(View view);

  FrameParts parts;
  std::vector<DrawnBody> bodies;
  std::map<View, std::unique_ptr<ViewPainter>> painters;  // of the views that were drawn so far
  Image legend;
};

MeshRenderer::Impl::Impl(const Settings& settings, const std::vector<DrawnBody>& bodies, const RunBounds& bounds,
                         const DrawingOptions& options)
    : parts(settings, bodies, bounds, options),
      bodies(bodies),
      legend(draw_legend(settings.velocity_colour, parts.velocity_range, settings.width, settings.height)) {
  check_gl(parts.gl(), "setting up");
}

const ViewPainter& MeshRenderer::Impl::painter(View view) {
  std::unique_ptr<ViewPainter>& painter = painters[view];
  if (!painter) painter = drawing_of(view).make(parts, bodies);
  return *painter;
}

MeshRenderer::MeshRenderer(const Settings& settings, std::vector<DrawnBody> bodies, const RunBounds& bounds,
                           const DrawingOptions& options)
    : impl_(std::make_unique<Impl>(settings, bodies, bounds, options)) {}

MeshRenderer::~MeshRenderer() = default;

Picture MeshRenderer::draw(View view, const std::vector<sim::SurfaceState>& bodies,
                           const Eigen::Vector3d& camera_velocity, double time) {
  FrameParts& parts = impl_->parts;
  const ViewDrawing& drawing = drawing_of(view);
  parts.context.make_current();
  parts.update(bodies, time);
  parts.camera_velocity = camera_velocity;
  Picture frame = impl_->painter(view).draw(parts);
  check_gl(parts.gl(), "drawing a frame");
  if (drawing.legend && parts.settings.legend && !parts.settings.background.none)
    add_legend(std::get<Image>(frame), impl_->legend);
  return frame;
}

double MeshRenderer::velocity_range() const { return impl_->parts.velocity_range; }

const Backend& MeshRenderer::backend() const { return impl_->parts.context.backend(); }

std::string MeshRenderer::description() const { return impl_->parts.context.description(); }

}  // namespace billow::render
