// The legend, drawn with cairo.
#include "render/paper/legend.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "render/image/colour_map.h"
#include "render/paper/canvas.h"

namespace billow::render {
namespace {

// In units of a 720-pixel-high frame.
constexpr double bar_width = 190.0, bar_height = 12.0, bar_pitch = 20.0;
constexpr double padding = 14.0, name_width = 16.0, title_height = 24.0, tick_height = 20.0;
constexpr double font_size = 13.0;
constexpr double frame_margin = 20.0;
constexpr double ink = 0.16, paper = 0.98, paper_alpha = 0.82;

int bar_count(VelocityColour colour) { return colour == VelocityColour::components ? 3 : 1; }

double legend_width(VelocityColour colour) {
  return 2.0 * padding + bar_width + (bar_count(colour) > 1 ? name_width : 0.0);
}

double legend_height(VelocityColour colour) {
  return 2.0 * padding + title_height + tick_height + bar_pitch * (bar_count(colour) - 1) + bar_height;
}

// Below this, text cannot be read.
double legend_scale(int frame_height) { return std::max(0.7, frame_height / 720.0); }

void draw_bar(cairo_t* pen, VelocityColour colour, int axis, double x, double y) {
  cairo_pattern_t* gradient = cairo_pattern_create_linear(x, 0.0, x + bar_width, 0.0);
  for (int stop = 0; stop <= 32; ++stop) {
    const Rgb8 c = colour_along(colour, axis, stop / 32.0);
    cairo_pattern_add_color_stop_rgb(gradient, stop / 32.0, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
  }
  cairo_rectangle(pen, x, y, bar_width, bar_height);
  cairo_set_source(pen, gradient);
  cairo_fill(pen);
  cairo_pattern_destroy(gradient);
}

void draw_paper(cairo_t* pen, double width, double height) {
  const double r = 8.0, pi = 3.14159265358979;
  cairo_new_sub_path(pen);
  cairo_arc(pen, width - r, r, r, -0.5 * pi, 0.0);
  cairo_arc(pen, width - r, height - r, r, 0.0, 0.5 * pi);
  cairo_arc(pen, r, height - r, r, 0.5 * pi, pi);
  cairo_arc(pen, r, r, r, pi, 1.5 * pi);
  cairo_close_path(pen);
  cairo_set_source_rgba(pen, paper, paper, paper, paper_alpha);
  cairo_fill(pen);
}

std::string number(double value) {
  const std::string digits = fmt::format("{:.3g}", std::abs(value));
  return value < 0.0 ? "\u2212" + digits : digits;
}

void draw_ticks(Canvas& canvas, VelocityColour colour, double velocity_range, double x, double y) {
  const double low = colour == VelocityColour::components ? -velocity_range : 0.0;
  for (int tick = 0; tick <= 2; ++tick) {
    const double t = 0.5 * tick, at = x + t * bar_width;
    canvas.fill_rectangle(at - 0.5, y + 2.0, 1.0, 4.0, ink);
    const double value = low + t * (velocity_range - low);
    canvas.write((value > 0.0 && low < 0.0 ? "+" : "") + number(value), at, y + tick_height, t);
  }
}

void draw_all(Canvas& canvas, VelocityColour colour, double velocity_range) {
  const bool components = colour == VelocityColour::components;
  const double x = padding + (components ? name_width : 0.0);
  double y = padding;
  draw_paper(canvas.pen(), legend_width(colour), legend_height(colour));
  canvas.write(components ? "velocity along" : "speed", padding, y + font_size, 0.0);
  canvas.write("m/s", x + bar_width, y + font_size, 1.0);
  y += title_height;
  for (int axis = 0; axis < bar_count(colour); ++axis, y += bar_pitch) {
    if (components) canvas.write(std::string(1, "xyz"[axis]), padding, y + bar_height - 1.0, 0.0);
    draw_bar(canvas.pen(), colour, axis, x, y);
  }
  draw_ticks(canvas, colour, velocity_range, x, y - bar_pitch + bar_height);
}

}  // namespace

Image draw_legend(VelocityColour colour, double velocity_range, int frame_height) {
  const double scale = legend_scale(frame_height);
  const int width = static_cast<int>(std::ceil(scale * legend_width(colour)));
  const int height = static_cast<int>(std::ceil(scale * legend_height(colour)));
  Canvas canvas(width, height, scale);
  canvas.set_font(font_size);
  draw_all(canvas, colour, velocity_range);
  return canvas.rgba();
}

void add_legend(Image& frame, const Image& legend) {
  const int margin = static_cast<int>(frame_margin * legend_scale(frame.height));
  const int left = margin, top = frame.height - margin - legend.height;
  if (top < 0 || left + legend.width > frame.width) return;
  for (int y = 0; y < legend.height; ++y) {
    const std::uint8_t* over = legend.row(y);
    std::uint8_t* under = frame.row(top + y) + 3 * left;
    for (int x = 0; x < legend.width; ++x, over += 4, under += 3)
      for (int c = 0; c < 3; ++c)
        under[c] = static_cast<std::uint8_t>(over[c] + (under[c] * (255 - over[3]) + 127) / 255);
  }
}

}  // namespace billow::render
