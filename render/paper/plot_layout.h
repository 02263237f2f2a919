// Where everything of a plot stands on its page, measured with the font that it is written in.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/paper/plot.h"
#include "render/paper/plot_arrangement.h"
#include "render/paper/plot_axis.h"

namespace billow::render {

// All in pixels from the upper left corner.

/// One line of text, its middle at `y`; `align`: 0 starts at x, 1/2 is centred on it. `upright` reads upwards, centred.
struct PlacedText {
  std::string text;
  double x = 0.0, y = 0.0, size = 0.0, align = 0.0;
  bool bold = false, quiet = false, upright = false;
};

/// A sample of a colour, or of a mark with its dashes, or of both; -1: none. `length` long from x, at height y.
struct Sample {
  double x = 0.0, y = 0.0;
  int colour = -1, mark = -1;
};

/// The axes of one panel and the curves within, by their indices.
struct PlacedPanel {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
  PlotAxis x, y;
  bool names_x = true, names_y = true;  // its ticks have labels
  std::vector<std::size_t> curves;
};

struct PlotLayout {
  int width = 0, height = 0;
  double tick_size = 0.0;  // of the font
  bool upright_x = false;  // the labels along x are turned
  std::vector<PlacedText> texts;
  std::vector<Sample> samples;
  std::vector<PlacedPanel> panels;
  std::vector<Look> looks;  // per curve
};

inline constexpr double sample_length = 44.0;

/// Whether a point can be shown: logarithms exist of positive numbers only.
bool is_shown(const Plot& plot, double x, double y);

/// Whether any of a curve's points can be shown.
bool has_points(const Plot& plot, const Curve& curve);

/// Panels without a point are left out; there is none where no curve has any. Throws InputError where the page would be
/// too large.
PlotLayout lay_out(const Plot& plot);

}  // namespace billow::render
