// Layout from the top down: first measured, then drawn by the same code.
#include "render/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/canvas.h"
#include "sim/error.h"

namespace billow::render {

namespace {

constexpr int margin = 28, gap = 12;
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

double left_edge(const Sheet& sheet, const SheetRow& row, std::size_t panel) {
  if (!row.times.empty()) return place_of(sheet, row.times[panel]);
  double x = margin;
  for (std::size_t p = 0; p < panel; ++p) x += row.panels[p].width + gap;
  return x;
}

double right_edge(const Sheet& sheet) {
  double right = margin + sheet.axis_width;
  for (const SheetRow& row : sheet.rows)
    for (std::size_t p = 0; p < row.panels.size(); ++p)
      right = std::max(right, left_edge(sheet, row, p) + row.panels[p].width);
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
  for (int tick = 0; sheet.begin + tick * step <= sheet.end * (1.0 + 1e-9); ++tick) {
    const double time = sheet.begin + tick * step, x = place_of(sheet, time);
    canvas.fill_rectangle(x - 0.5, y + 6.0, 1.0, 6.0, rule);
    canvas.write(fmt::format("{:.6g}{}", time, tick == 0 ? " s" : ""), x, y + 28.0, tick == 0 ? 0.0 : 0.5, quiet);
  }
}

void draw_panel(Canvas& canvas, const Panel& panel, double x, double y) {
  canvas.place(panel.image, x, y, panel.width, panel.height, panel.smooth);
  if (panel.caption.empty()) return;
  canvas.set_font(small_size);
  canvas.write(panel.caption, x + 0.5 * panel.width, y + panel.height + 17.0, 0.5, quiet);
}

// Returns where the next row begins.
int draw_row(Canvas& canvas, const Sheet& sheet, const SheetRow& row, int y) {
  if (!row.label.empty()) {
    canvas.set_font(label_size, true);
    canvas.write(row.label, margin, y + 19.0, 0.0, ink);
    y += label_height;
  }
  for (std::size_t p = 0; p < row.panels.size(); ++p) draw_panel(canvas, row.panels[p], left_edge(sheet, row, p), y);
  y += panels_height(row) + (has_caption(row) ? caption_height : 0);
  if (row.axis_below) draw_axis(canvas, sheet, y), y += axis_height;
  return y + gap;
}

int draw_columns(Canvas& canvas, const Sheet& sheet, int y) {
  if (sheet.columns.empty()) return y;
  const SheetRow& row = sheet.rows.front();
  canvas.set_font(label_size, true);
  for (std::size_t c = 0; c < std::min(sheet.columns.size(), row.panels.size()); ++c)
    canvas.write(sheet.columns[c], left_edge(sheet, row, c), y + 19.0, 0.0, ink);
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
  for (const SheetRow& row : sheet.rows) y = draw_row(canvas, sheet, row, y);
  return draw_text(canvas, sheet.note, small_size, false, quiet, line_height, width, y) + margin - gap;
}

}  // namespace

Image draw_sheet(const Sheet& sheet) {
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
