// The velocity view's labelled scale.
#pragma once

#include "render/image/image.h"
#include "render/image/settings.h"

namespace billow::render {

/// A small RGBA picture (alpha premultiplied) for a frame of `frame_height` pixels: which colour is which velocity,
/// up to `velocity_range` [m/s].
Image draw_legend(VelocityColour colour, double velocity_range, int frame_height);

/// Lays `legend` over `frame` (RGB) near its lower left corner; left out where the frame is too small to hold it.
void add_legend(Image& frame, const Image& legend);

}  // namespace billow::render
