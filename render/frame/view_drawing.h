// The table of the views' drawings: a row for each view. A new view is a row here and in image/views.cpp, its shaders,
// and a file with its painter.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "render/frame/frame_parts.h"
#include "render/image/picture.h"
#include "render/image/views.h"

namespace billow::render {

/// Draws the frames of one view; holds what of GL only that view needs.
class ViewPainter {
 public:
  virtual ~ViewPainter() = default;
  /// The picture of the bodies where they are now. Must leave nothing behind that another view's frame would show.
  virtual Picture draw(FrameParts& frame) const = 0;
};

struct ViewDrawing {
  View view;
  bool legend;  // the scale of velocities is laid over it, where the settings want one
  std::unique_ptr<ViewPainter> (*make)(const FrameParts& frame, const std::vector<DrawnBody>& bodies);
};

/// One for each row of views().
std::span<const ViewDrawing> view_drawings();
/// Throws std::logic_error when the view has no row.
const ViewDrawing& drawing_of(View view);

// The makers, each in the file of its view. `frame` holds the same bodies; its context is current.
std::unique_ptr<ViewPainter> make_textured_painter(const FrameParts& frame, const std::vector<DrawnBody>& bodies);
std::unique_ptr<ViewPainter> make_velocity_painter(const FrameParts& frame, const std::vector<DrawnBody>& bodies);
std::unique_ptr<ViewPainter> make_data_painter(const FrameParts& frame, const std::vector<DrawnBody>& bodies);
std::unique_ptr<ViewPainter> make_depth_painter(const FrameParts& frame, const std::vector<DrawnBody>& bodies);
std::unique_ptr<ViewPainter> make_normal_painter(const FrameParts& frame, const std::vector<DrawnBody>& bodies);
std::unique_ptr<ViewPainter> make_id_painter(const FrameParts& frame, const std::vector<DrawnBody>& bodies);

}  // namespace billow::render
