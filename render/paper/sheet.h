// Pictures side by side on a white page, with titles, labels and a time axis.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/image/image.h"

namespace billow::render {

/// An image on a sheet, stretched to width x height pixels. `smooth` filters; otherwise pixels stay sharp squares.
struct Panel {
  Image image;
  int width = 0, height = 0;
  bool smooth = true;
  std::string caption;  // below it
};

/// Panels from left to right. Where a time axis runs along the sheet, a panel with a time stands at it, or beside it
/// where its neighbours or the axis' end leave no room, and is linked to it by a line from the axis above.
struct SheetRow {
  std::string label;  // above the row
  std::vector<Panel> panels;
  std::vector<double> times;  // [s] of the panels' left edges on the sheet's time axis; empty: one after another
  bool axis_below = false;    // draw the sheet's time axis under this row
};

struct Sheet {
  std::string title, note;
  std::vector<std::string> columns;  // headings above the first row's panels
  double begin = 0.0, end = 0.0;     // [s] the time axis, as wide as `axis_width`; none where end == begin
  int axis_width = 0;                // [pixel]
  std::vector<SheetRow> rows;
};

/// RGB, as large as its panels and their words need. Throws InputError when that is more than 16384 pixels a side, when
/// a panel has no pixels or no size, when a row has some times but not one per panel, or when a time axis is empty.
Image draw_sheet(const Sheet& sheet);

}  // namespace billow::render
