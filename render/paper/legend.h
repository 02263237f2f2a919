// The velocity view's labelled scale.
#pragma once

#include <string>
#include <vector>

#include "render/image/image.h"
#include "render/image/settings.h"

namespace billow::render {

/// The velocities [m/s] at the low end, the middle and the high end of a scale up to `velocity_range`, as it says them.
std::vector<std::string> legend_numbers(VelocityColour colour, double velocity_range);

/// An RGBA picture (alpha premultiplied) to lay over the lower left corner of a frame of width x height pixels: which
/// colour is which velocity, up to `velocity_range` [m/s]. It grows and shrinks with the frame; where a block of bars
/// could not be read any more it is one line, and where that would not fit either it has no pixels.
Image draw_legend(VelocityColour colour, double velocity_range, int width, int height);

/// Lays `legend`, made for a frame of this size, over `frame` (RGB).
void add_legend(Image& frame, const Image& legend);

}  // namespace billow::render
