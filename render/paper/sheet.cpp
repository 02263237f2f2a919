// Layout from the top down: first measured, then drawn by the same code.
#include "render/paper/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/readable_number.h"
#include "render/paper/canvas.h"
#include "render/paper/plot_axis.h"

namespace billow::render {

namespace {

constexpr int margin = 28, gap = 12, timed_gap = 6;
constexpr double title_size = 22.0, label_size = 16.0, small_size = 14.0;
constexpr double ink = 0.13, quiet = 0.40, rule = 0.55;
constexpr int title_height = 38, label_height = 28, caption_height = 24, axis_height = 44, line_height = 22;
constexpr int label_line = 21, caption_line = 19;  // from one to the next where a text takes several
constexpr int link_height = 18;                    // from the axis' numbers to linked panels
constexpr double scale_width = 240.0, scale_bar = 11.0, scale_pitch = 16.0, scale_title = 24.0, scale_numbers = 26.0;
constexpr double scale_name = 18.0, scale_gap = 48.0;
constexpr int largest_side = 16384;

int panels_height(const SheetRow& row) {
  int height = 0;
  for (const Panel& panel : row.panels) height = std::max(height, panel.height);
  return height;
}

double place_of(const Sheet& sheet, double time) {
  return margin + sheet.axis_width * (time - sheet.begin) / (sheet.end - sheet.begin);
}

std::vector<double> one_after_another(const SheetRow& row) {
  std::vector<double> left;
  double x = margin;
  for (const Panel& panel : row.panels) left.push_back(x), x += panel.width + gap;
  return left;
}

// Each at its time, or as near to it as its neighbours and the axis' end allow: pushed to the right by those before it,
// then back to the left by the end. More than the axis holds runs over its end.
std::vector<double> at_their_times(const Sheet& sheet, const SheetRow& row) {
  std::vector<std::size_t> order(row.panels.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return row.times[a] < row.times[b]; });
  std::vector<double> left(order.size());
  double free = margin, total = -timed_gap;
  for (const std::size_t p : order) {
    left[p] = std::max(free, place_of(sheet, row.times[p]));
    free = left[p] + row.panels[p].width + timed_gap;
    total += row.panels[p].width + timed_gap;
  }
  double end = margin + std::max<double>(sheet.axis_width, total);
  for (auto p = order.rbegin(); p != order.rend(); ++p) {
    left[*p] = std::min(left[*p], end - row.panels[*p].width);
    end = left[*p] - timed_gap;
  }
  return left;
}

std::vector<double> left_edges(const Sheet& sheet, const SheetRow& row) {
  return row.times.empty() ? one_after_another(row) : at_their_times(sheet, row);
}

bool has_names(const SheetScale& scale) {
  return std::any_of(scale.bars.begin(), scale.bars.end(), [](const auto& bar) { return !bar.name.empty(); });
}

double width_of(const SheetScale& scale) {
  Canvas measure(1, 1);
  measure.set_font(small_size);
  return std::max(measure.text_width(scale.title), scale_width + (has_names(scale) ? scale_name : 0.0));
}

int height_of(const SheetScale& scale) {
  return static_cast<int>(scale_title + scale_pitch * static_cast<double>(scale.bars.size()) + scale_numbers);
}

double right_edge(const Sheet& sheet) {
  double right = margin + sheet.axis_width;
  for (const SheetRow& row : sheet.rows) {
    const std::vector<double> left = left_edges(sheet, row);
    for (std::size_t p = 0; p < left.size(); ++p) right = std::max(right, left[p] + row.panels[p].width);
  }
  for (const SheetScale& scale : sheet.scales) right = std::max(right, margin + width_of(scale));
  return right;
}

void draw_axis(Canvas& canvas, const Sheet& sheet, double y) {
  canvas.fill_rectangle(margin, y + 6.0, sheet.axis_width, 1.0, rule);
  canvas.set_font(small_size);
  const double step = round_step(sheet.end - sheet.begin, 10.0);
  const double first = std::ceil(sheet.begin / step - 1e-9) + 0.0;  // never -0
  const double last = std::floor(sheet.end / step + 1e-9);
  for (double tick = first; tick <= last; ++tick) {
    const double time = tick * step, x = place_of(sheet, time);
    canvas.fill_rectangle(x - 0.5, y + 6.0, 1.0, 6.0, rule);
    canvas.write(fmt::format("{:.6g}{}", time, tick == first ? " s" : ""), x, y + 28.0, tick == first ? 0.0 : 0.5,
                 quiet);
  }
}

// From each panel's time on the axis to its left edge: marks on the axis at `axis`, and lines that start below the
// axis' numbers.
void draw_links(Canvas& canvas, const Sheet& sheet, const SheetRow& row, double axis, double panels) {
  const std::vector<double> left = left_edges(sheet, row);
  for (std::size_t p = 0; p < left.size(); ++p) {
    const double x = place_of(sheet, row.times[p]);
    canvas.fill_rectangle(x - 1.0, axis + 6.0, 2.0, 7.0, ink);
    canvas.draw_line(x, axis + 35.0, left[p] + 0.5, panels, rule);
  }
}

// Lines of a text, each aligned at `x`; returns the height of all but what a single one takes anyway.
int draw_lines(Canvas& canvas, const std::vector<std::string>& lines, double x, double baseline, double align,
               double grey, int pitch) {
  for (std::size_t l = 0; l < lines.size(); ++l)
    canvas.write(lines[l], x, baseline + static_cast<double>(pitch) * static_cast<double>(l), align, grey);
  return pitch * std::max(0, static_cast<int>(lines.size()) - 1);
}

void draw_panel(Canvas& canvas, const Panel& panel, double x, double y) {
  canvas.place(panel.image, x, y, panel.width, panel.height, panel.smooth);
}

// Returns the height that the captions of the row take.
int draw_captions(Canvas& canvas, const SheetRow& row, const std::vector<double>& left, int y) {
  int height = 0;
  canvas.set_font(small_size);
  for (std::size_t p = 0; p < row.panels.size(); ++p) {
    const Panel& panel = row.panels[p];
    if (panel.caption.empty()) continue;
    const auto lines = canvas.lines_of(panel.caption, panel.width);
    height = std::max(height, caption_height + draw_lines(canvas, lines, left[p] + 0.5 * panel.width,
                                                          y + panel.height + 17.0, 0.5, quiet, caption_line));
  }
  return height;
}

// Returns the height that the headings of the row take.
int draw_headings(Canvas& canvas, const SheetRow& row, const std::vector<double>& left, int y) {
  int height = 0;
  canvas.set_font(label_size, true);
  for (std::size_t p = 0; p < row.panels.size(); ++p)
    if (const Panel& panel = row.panels[p]; !panel.heading.empty()) {
      const auto lines = canvas.lines_of(panel.heading, panel.width);
      height = std::max(height, label_height + draw_lines(canvas, lines, left[p], y + 19.0, 0.0, ink, label_line));
    }
  return height;
}

// Returns the height that it takes.
int draw_label(Canvas& canvas, const std::string& label, double width, int y) {
  if (label.empty()) return 0;
  canvas.set_font(label_size, true);
  return label_height + draw_lines(canvas, canvas.lines_of(label, width), margin, y + 19.0, 0.0, ink, label_line);
}

// Returns where the next row begins. Nothing is written across the lines to a row that is linked to the axis at `axis`.
int draw_row(Canvas& canvas, const Sheet& sheet, const SheetRow& row, double width, std::optional<int> axis, int y) {
  const bool linked = axis && !row.times.empty();
  y += linked ? link_height : draw_label(canvas, row.label, width, y);
  if (linked) draw_links(canvas, sheet, row, *axis, y);
  const std::vector<double> left = left_edges(sheet, row);
  y += draw_headings(canvas, row, left, y);
  for (std::size_t p = 0; p < row.panels.size(); ++p) draw_panel(canvas, row.panels[p], left[p], y);
  const int captions = draw_captions(canvas, row, left, y);
  y += panels_height(row) + captions;
  if (linked) y += draw_label(canvas, row.label, width, y);
  if (row.axis_below) draw_axis(canvas, sheet, y), y += axis_height;
  return y + gap;
}

int draw_rows(Canvas& canvas, const Sheet& sheet, double width, int y) {
  std::optional<int> axis;
  for (const SheetRow& row : sheet.rows) {
    y = draw_row(canvas, sheet, row, width, axis, y);
    if (row.axis_below) axis = y - gap - axis_height;
  }
  return y;
}

// As an image of one row: `place` stretches it.
Image bar_image(const std::vector<Rgb8>& colours) {
  Image image(static_cast<int>(colours.size()), 1);
  for (std::size_t k = 0; k < colours.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * k + c] = colours[k][c];
  return image;
}

// What motion along one axis, or a speed, looks like.
std::vector<Rgb8> scale_colours(VelocityColour colour, int axis) {
  std::vector<Rgb8> colours;
  for (int k = 0; k < 256; ++k) colours.push_back(colour_along(colour, axis, k / 255.0));
  return colours;
}

void draw_scale(Canvas& canvas, const SheetScale& scale, double x, double y) {
  canvas.set_font(small_size);
  canvas.write(scale.title, x, y + 15.0, 0.0, ink);
  const double left = x + (has_names(scale) ? scale_name : 0.0);
  double top = y + scale_title;
  for (const SheetScale::Bar& bar : scale.bars) {
    canvas.write(bar.name, x, top + scale_bar - 1.0, 0.0, ink);
    canvas.place(bar_image(bar.colours), left, top, scale_width, scale_bar, true);
    top += scale_pitch;
  }
  top += scale_bar - scale_pitch;
  for (const double at : {0.0, 0.5, 1.0}) {
    canvas.fill_rectangle(left + at * (scale_width - 1.0), top + 1.0, 1.0, 4.0, quiet);
    canvas.write(at == 0.0   ? scale.low
                 : at == 1.0 ? scale.high
                             : scale.middle,
                 left + at * scale_width, top + 20.0, at, quiet);
  }
}

// Side by side as far as the sheet is wide.
int draw_scales(Canvas& canvas, const Sheet& sheet, double width, int y) {
  double x = margin;
  int height = 0;
  for (const SheetScale& scale : sheet.scales) {
    if (x > margin && x + width_of(scale) > margin + width) {
      x = margin;
      y += height;
      height = 0;
    }
    draw_scale(canvas, scale, x, y);
    x += width_of(scale) + scale_gap;
    height = std::max(height, height_of(scale) + 8);
  }
  return y + height;
}

int draw_text(Canvas& canvas, const std::string& text, double size, bool bold, double grey, int height, double width,
              int y) {
  canvas.set_font(size, bold);
  for (const std::string& line : canvas.lines_of(text, width)) {
    canvas.write(line, margin, y + size, 0.0, grey);
    y += height;
  }
  return y;
}

// Draws everything and returns the height that it took.
int draw_all(Canvas& canvas, const Sheet& sheet, double width) {
  int y = draw_text(canvas, sheet.title, title_size, true, ink, title_height, width, margin);
  y = draw_rows(canvas, sheet, width, y);
  y = draw_scales(canvas, sheet, width, y);
  return draw_text(canvas, sheet.note, small_size, false, quiet, line_height, width, y) + margin - gap;
}

void check_panel(const Panel& panel) {
  if (panel.image.width <= 0 || panel.image.height <= 0)
    throw InputError("a sheet cannot show a picture without pixels; leave it out");
  if (panel.width <= 0 || panel.height <= 0)
    throw InputError(
        fmt::format("a picture cannot be shown at {} x {} pixels; make it larger", panel.width, panel.height));
  if (panel.width > largest_side || panel.height > largest_side)
    throw InputError(
        fmt::format("a picture of {} x {} pixels does not fit on a sheet; show it smaller", panel.width, panel.height));
}

void check(const Sheet& sheet) {
  for (const SheetRow& row : sheet.rows) {
    const bool timed = !row.times.empty() || row.axis_below;
    if (timed && (sheet.axis_width <= 0 || !(sheet.begin < sheet.end)))
      throw InputError(fmt::format("a sheet's time axis from {:g} s to {:g} s is empty; make it end after it begins",
                                   sheet.begin, sheet.end));
    if (!row.times.empty() && row.times.size() != row.panels.size())
      throw InputError(fmt::format("{} pictures of a row have {} times; give each one, or none", row.panels.size(),
                                   row.times.size()));
    for (const Panel& panel : row.panels) check_panel(panel);
  }
}

}  // namespace

SheetScale velocity_scale(VelocityColour colour, double velocity_range) {
  const std::string end = readable(velocity_range, 3);
  if (colour == VelocityColour::magnitude)
    return {"speed [m/s]", {{"", scale_colours(colour, 0)}}, "0", readable(0.5 * velocity_range, 3), end};
  SheetScale scale{"velocity along each axis [m/s]", {}, "\u2212" + end, "0", "+" + end};
  for (int axis = 0; axis < 3; ++axis) scale.bars.push_back({std::string(1, "xyz"[axis]), scale_colours(colour, axis)});
  return scale;
}

SheetScale power_scale(double range) {
  std::vector<Rgb8> greys;
  for (int grey = 0; grey < 256; ++grey) {
    const auto level = static_cast<std::uint8_t>(grey);
    greys.push_back({level, level, level});
  }
  return {"power relative to the strongest [dB]",
          {{"", greys}},
          "\u2212" + readable(range, 3),
          "\u2212" + readable(0.5 * range, 3),
          "0"};
}

Image draw_sheet(const Sheet& sheet) {
  check(sheet);
  const double right = right_edge(sheet);
  const int width = static_cast<int>(std::ceil(right)) + margin;
  Canvas measure(1, 1);
  const int height = draw_all(measure, sheet, right - margin);
  if (width > largest_side || height > largest_side)
    throw InputError(
        fmt::format("a sheet of {} x {} pixels is too large; show fewer or smaller pictures", width, height));
  Canvas canvas(width, height);
  canvas.fill_rectangle(0.0, 0.0, width, height, 1.0);
  draw_all(canvas, sheet, right - margin);
  return on_white(canvas.rgba());
}

}  // namespace billow::render
