// Pictures side by side on a white page, with titles, labels and a time axis.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/image/colour_map.h"
#include "render/image/image.h"

namespace billow::render {

/// An image on a sheet, stretched to width x height pixels. `smooth` filters; otherwise pixels stay sharp squares.
struct Panel {
  Image image;
  int width = 0, height = 0;
  bool smooth = true;
  std::string caption;       // below it
  std::string heading = {};  // above it
};

/// Panels from left to right. Where a time axis runs along the sheet, a panel with a time stands at it, or beside it
/// where its neighbours or the axis' end leave no room, and is linked to it by a line from the axis above.
struct SheetRow {
  std::string label;  // above the row; below it where its panels are linked to the time axis
  std::vector<Panel> panels;
  std::vector<double> times;  // [s] of the panels' left edges on the sheet's time axis; empty: one after another
  bool axis_below = false;    // draw the sheet's time axis under this row
};

/// Which colour is which value: bars of the same scale below each other, and what their ends and middle stand for.
struct SheetScale {
  struct Bar {
    std::string name;           // left of it
    std::vector<Rgb8> colours;  // from low to high, at equal distances
  };
  std::string title;
  std::vector<Bar> bars;
  std::string low, middle, high;
};

/// The velocity view's colours up to `velocity_range` [m/s].
SheetScale velocity_scale(VelocityColour colour, double velocity_range);
/// A spectrum's greys, down to `range` [dB] below the strongest.
SheetScale power_scale(double range);

struct Sheet {
  std::string title, note;
  double begin = 0.0, end = 0.0;  // [s] the time axis, as wide as `axis_width`; none where end == begin
  int axis_width = 0;             // [pixel]
  std::vector<SheetRow> rows;
  std::vector<SheetScale> scales = {};  // below the rows
};

/// RGB, as large as its panels and their words need. Throws InputError when that is more than 16384 pixels a side, when
/// a panel has no pixels or no size, when a row has some times but not one per panel, or when a time axis is empty.
Image draw_sheet(const Sheet& sheet);

}  // namespace billow::render
