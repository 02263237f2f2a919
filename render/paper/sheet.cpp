// Layout from the top down: first measured, then drawn by the same code.
#include "render/paper/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "render/paper/canvas.h"

namespace billow::render {

namespace {

constexpr int margin = 28, gap = 12, timed_gap = 6;
constexpr double title_size = 22.0, label_size = 16.0, small_size = 14.0;
constexpr double ink = 0.13, quiet = 0.40, rule = 0.55;
constexpr int title_height = 38, label_height = 28, caption_height = 24, axis_height = 44, line_height = 22;
constexpr int largest_side = 16384;

bool has_caption(const SheetRow& row) {
  return std::any_of(row.panels.begin(), row.panels.end(), [](const Panel& panel) { return !panel.caption.empty(); });
}

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

double right_edge(const Sheet& sheet) {
  double right = margin + sheet.axis_width;
  for (const SheetRow& row : sheet.rows) {
    const std::vector<double> left = left_edges(sheet, row);
    for (std::size_t p = 0; p < left.size(); ++p) right = std::max(right, left[p] + row.panels[p].width);
  }
  return right;
}

// A round step of which about `wanted` fit into `span`: 1, 2 or 5 times a power of ten.
double round_step(double span, double wanted) {
  const double raw = span / wanted, power = std::pow(10.0, std::floor(std::log10(raw)));
  const double digit = raw / power;
  return power * (digit <= 1.0 ? 1.0 : digit <= 2.0 ? 2.0 : digit <= 5.0 ? 5.0 : 10.0);
}

// Words of `text` in lines no wider than `width`.
std::vector<std::string> lines_of(Canvas& canvas, const std::string& text, double width) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!lines.empty() && canvas.text_width(lines.back() + " " + word) <= width)
      lines.back() += " " + word;
    else
      lines.push_back(word);
    begin = end + 1;
  }
  return lines;
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

void draw_panel(Canvas& canvas, const Panel& panel, double x, double y) {
  canvas.place(panel.image, x, y, panel.width, panel.height, panel.smooth);
  if (panel.caption.empty()) return;
  canvas.set_font(small_size);
  canvas.write(panel.caption, x + 0.5 * panel.width, y + panel.height + 17.0, 0.5, quiet);
}

// In front of the lines that may cross it.
void draw_label(Canvas& canvas, const std::string& label, int y) {
  canvas.set_font(label_size, true);
  canvas.fill_rectangle(margin, y + 3.0, canvas.text_width(label) + 4.0, label_size + 5.0, 1.0);
  canvas.write(label, margin, y + 19.0, 0.0, ink);
}

int panels_top(const SheetRow& row, int y) { return y + (row.label.empty() ? 0 : label_height); }

// Returns where the next row begins.
int draw_row(Canvas& canvas, const Sheet& sheet, const SheetRow& row, int y) {
  if (!row.label.empty()) draw_label(canvas, row.label, y);
  y = panels_top(row, y);
  const std::vector<double> left = left_edges(sheet, row);
  for (std::size_t p = 0; p < row.panels.size(); ++p) draw_panel(canvas, row.panels[p], left[p], y);
  y += panels_height(row) + (has_caption(row) ? caption_height : 0);
  if (row.axis_below) draw_axis(canvas, sheet, y), y += axis_height;
  return y + gap;
}

int draw_rows(Canvas& canvas, const Sheet& sheet, int y) {
  std::optional<int> axis;
  for (const SheetRow& row : sheet.rows) {
    if (axis && !row.times.empty()) draw_links(canvas, sheet, row, *axis, panels_top(row, y));
    y = draw_row(canvas, sheet, row, y);
    if (row.axis_below) axis = y - gap - axis_height;
  }
  return y;
}

int draw_columns(Canvas& canvas, const Sheet& sheet, int y) {
  if (sheet.columns.empty()) return y;
  const std::vector<double> left = left_edges(sheet, sheet.rows.front());
  canvas.set_font(label_size, true);
  for (std::size_t c = 0; c < std::min(sheet.columns.size(), left.size()); ++c)
    canvas.write(sheet.columns[c], left[c], y + 19.0, 0.0, ink);
  return y + label_height;
}

int draw_text(Canvas& canvas, const std::string& text, double size, bool bold, double grey, int height, double width,
              int y) {
  canvas.set_font(size, bold);
  for (const std::string& line : lines_of(canvas, text, width)) {
    canvas.write(line, margin, y + size, 0.0, grey);
    y += height;
  }
  return y;
}

// Draws everything and returns the height that it took.
int draw_all(Canvas& canvas, const Sheet& sheet, double width) {
  int y = draw_text(canvas, sheet.title, title_size, true, ink, title_height, width, margin);
  y = draw_columns(canvas, sheet, y);
  y = draw_rows(canvas, sheet, y);
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
