// The legend, drawn with cairo: a block of bars, or in small frames one line.
#include "render/paper/legend.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>

#include "base/readable_number.h"
#include "render/image/colour_map.h"
#include "render/paper/canvas.h"

namespace billow::render {
namespace {

// Lengths are in units of a pixel of a frame of 1280 x 720, unless said otherwise.
constexpr double font_size = 13.0;
constexpr double letter_ink = 0.16, paper = 0.98,
                 paper_alpha = 0.96;  // light enough and thick enough to be read over anything

// The block.
constexpr double bar_width = 190.0, bar_height = 12.0, bar_pitch = 20.0;
constexpr double padding = 14.0, name_width = 16.0, block_title_height = 24.0, tick_height = 20.0;
constexpr double block_margin = 20.0, block_corner = 8.0;
constexpr double widest_share = 0.36, highest_share = 0.25;  // of the frame
constexpr double least_block_scale = 0.65;                   // below this its letters cannot be read

// The line.
constexpr double line_legend_height = 20.0, line_padding = 6.0, line_margin = 7.0, line_corner = 4.0;
constexpr double line_bar_height = 10.0, longest_bar = 44.0, shortest_bar = 12.0;
constexpr double letter_gap = 4.0, bar_gap = 9.0;
constexpr double line_growth = 1.4;          // its letters beside the block's
constexpr double least_letters = 8.0;        // [pixel]
constexpr double highest_line_share = 0.14;  // of the frame

int bar_count(VelocityColour colour) { return colour == VelocityColour::components ? 3 : 1; }

double block_width(VelocityColour colour) {
  return 2.0 * padding + bar_width + (bar_count(colour) > 1 ? name_width : 0.0);
}

double block_height(VelocityColour colour) {
  return 2.0 * padding + block_title_height + tick_height + bar_pitch * (bar_count(colour) - 1) + bar_height;
}

// The same share of a frame's area, whatever the frame's shape.
double scale_by_area(int width, int height) { return std::sqrt(width / 1280.0 * (height / 720.0)); }

double block_scale(VelocityColour colour, int width, int height) {
  return std::min({scale_by_area(width, height), widest_share * width / block_width(colour),
                   highest_share * height / block_height(colour)});
}

struct Box {
  double x, y, width, height;
};

void draw_bar(cairo_t* pen, VelocityColour colour, int axis, const Box& box) {
  cairo_pattern_t* gradient = cairo_pattern_create_linear(box.x, 0.0, box.x + box.width, 0.0);
  for (int stop = 0; stop <= 32; ++stop) {
    const Rgb8 c = colour_along(colour, axis, stop / 32.0);
    cairo_pattern_add_color_stop_rgb(gradient, stop / 32.0, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
  }
  cairo_rectangle(pen, box.x, box.y, box.width, box.height);
  cairo_set_source(pen, gradient);
  cairo_fill(pen);
  cairo_pattern_destroy(gradient);
}

void draw_paper(cairo_t* pen, double width, double height, double corner) {
  const double r = corner, pi = 3.14159265358979;
  cairo_new_sub_path(pen);
  cairo_arc(pen, width - r, r, r, -0.5 * pi, 0.0);
  cairo_arc(pen, width - r, height - r, r, 0.0, 0.5 * pi);
  cairo_arc(pen, r, height - r, r, 0.5 * pi, pi);
  cairo_arc(pen, r, r, r, pi, 1.5 * pi);
  cairo_close_path(pen);
  cairo_set_source_rgba(pen, paper, paper, paper, paper_alpha);
  cairo_fill(pen);
}

void draw_ticks(Canvas& canvas, const std::vector<std::string>& numbers, double x, double y) {
  for (std::size_t tick = 0; tick < numbers.size(); ++tick) {
    const double t = 0.5 * static_cast<double>(tick), at = x + t * bar_width;
    canvas.fill_rectangle(at - 0.5, y + 2.0, 1.0, 4.0, letter_ink);
    canvas.write(numbers[tick], at, y + tick_height, t);
  }
}

void draw_block(Canvas& canvas, VelocityColour colour, double velocity_range) {
  const bool components = colour == VelocityColour::components;
  const double x = padding + (components ? name_width : 0.0);
  double y = padding;
  draw_paper(canvas.pen(), block_width(colour), block_height(colour), block_corner);
  canvas.write(components ? "velocity along" : "speed", padding, y + font_size, 0.0);
  canvas.write("m/s", x + bar_width, y + font_size, 1.0);
  y += block_title_height;
  for (int axis = 0; axis < bar_count(colour); ++axis, y += bar_pitch) {
    if (components) canvas.write(std::string(1, "xyz"[axis]), padding, y + bar_height - 1.0, 0.0);
    draw_bar(canvas.pen(), colour, axis, {x, y, bar_width, bar_height});
  }
  draw_ticks(canvas, legend_numbers(colour, velocity_range), x, y - bar_pitch + bar_height);
}

/// "x ▬ y ▬ z ▬ ±2.31 m/s" or "0 ▬ 2.31 m/s": a word before each bar, and one at the end.
struct LegendLine {
  std::vector<std::string> before;
  std::string end;
  double words_width = 0.0;  // and all between and around them: everything but the bars
};

LegendLine line_of(VelocityColour colour, double velocity_range) {
  LegendLine line;
  if (colour == VelocityColour::components)
    line = {{"x", "y", "z"}, "±" + readable(velocity_range, 3) + " m/s"};
  else
    line = {{"0"}, readable(velocity_range, 3) + " m/s"};
  Canvas measure(1, 1);
  measure.set_font(font_size);
  line.words_width = 2.0 * line_padding + measure.text_width(line.end);
  for (const std::string& word : line.before) line.words_width += measure.text_width(word) + letter_gap + bar_gap;
  return line;
}

void draw_line(Canvas& canvas, VelocityColour colour, const LegendLine& line, double bar) {
  const auto count = static_cast<int>(line.before.size());
  draw_paper(canvas.pen(), line.words_width + count * bar, line_legend_height, line_corner);
  const double baseline = 0.5 * line_legend_height + 0.36 * font_size;
  double x = line_padding;
  for (int axis = 0; axis < count; ++axis) {
    canvas.write(line.before[axis], x, baseline, 0.0);
    x += canvas.text_width(line.before[axis]) + letter_gap;
    draw_bar(canvas.pen(), colour, axis, {x, 0.5 * (line_legend_height - line_bar_height), bar, line_bar_height});
    x += bar + bar_gap;
  }
  canvas.write(line.end, x, baseline, 0.0);
}

/// A canvas for `width` x `height` units that stand `margin` off the frame's left and lower edges.
struct CornerCanvas : Canvas {
  CornerCanvas(double width, double height, double margin, double scale)
      : Canvas(static_cast<int>(std::ceil(scale * width) + std::round(scale * margin)),
               static_cast<int>(std::ceil(scale * height) + std::round(scale * margin)), scale) {
    cairo_translate(pen(), std::round(scale * margin) / scale, 0.0);
    set_font(font_size);
  }
};

Image block_legend(VelocityColour colour, double velocity_range, double scale) {
  CornerCanvas canvas(block_width(colour), block_height(colour), block_margin, scale);
  draw_block(canvas, colour, velocity_range);
  return canvas.rgba();
}

Image line_legend(VelocityColour colour, double velocity_range, int width, int height) {
  const double scale = std::max(least_letters / font_size, line_growth * scale_by_area(width, height));
  const LegendLine line = line_of(colour, velocity_range);
  const double room = width / scale - 2.0 * line_margin - line.words_width;
  const double bar = std::min(longest_bar, room / static_cast<double>(line.before.size()));
  if (bar < shortest_bar || scale * line_legend_height > highest_line_share * height) return {};
  CornerCanvas canvas(line.words_width + bar * static_cast<double>(line.before.size()), line_legend_height, line_margin,
                      scale);
  draw_line(canvas, colour, line, bar);
  return canvas.rgba();
}

}  // namespace

std::vector<std::string> legend_numbers(VelocityColour colour, double velocity_range) {
  if (colour == VelocityColour::magnitude) return {"0", readable(0.5 * velocity_range, 3), readable(velocity_range, 3)};
  return {readable(-velocity_range, 3), "0", "+" + readable(velocity_range, 3)};
}

Image draw_legend(VelocityColour colour, double velocity_range, int width, int height) {
  const double scale = block_scale(colour, width, height);
  return scale < least_block_scale ? line_legend(colour, velocity_range, width, height)
                                   : block_legend(colour, velocity_range, scale);
}

void add_legend(Image& frame, const Image& legend) {
  for (int y = 0; y < legend.height; ++y) {
    const std::uint8_t* over = legend.row(y);
    std::uint8_t* under = frame.row(frame.height - legend.height + y);
    for (int x = 0; x < legend.width; ++x, over += 4, under += 3)
      for (int c = 0; c < 3; ++c)
        under[c] = static_cast<std::uint8_t>(over[c] + (under[c] * (255 - over[3]) + 127) / 255);
  }
}

}  // namespace billow::render
