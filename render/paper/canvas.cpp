// The only file, with legend.cpp's shapes, that draws with cairo.
#include "render/paper/canvas.h"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "base/utf8.h"
#include "base/xml.h"

namespace billow::render {

namespace {

// Grey antialiasing and unhinted metrics: the same picture whatever the machine's font settings are.
void settle_font_options(cairo_t* pen) {
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(pen, options);
  cairo_font_options_destroy(options);
}

// Cairo's own layout: native-endian 0x00RRGGBB words.
std::vector<std::uint32_t> words_of(const Image& image, int stride) {
  std::vector<std::uint32_t> words(static_cast<std::size_t>(stride) / 4 * image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* pixel = image.row(y) + image.channels * x;
      words[static_cast<std::size_t>(y) * stride / 4 + x] =
          std::uint32_t{pixel[0]} << 16 | std::uint32_t{pixel[1]} << 8 | pixel[2];
    }
  return words;
}

// What cairo takes, all on one line.
std::string one_line(const std::string& text) {
  std::string line = xml_characters(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return line;
}

// How much of a word, in whole characters and at least one, is no wider than `width`.
std::size_t bytes_within(Canvas& canvas, const std::string& word, double width) {
  std::size_t fitting = 0;
  while (fitting < word.size()) {
    const std::size_t next =
        fitting + static_cast<std::size_t>(std::max(1, utf8_length(std::string_view(word).substr(fitting))));
    if (fitting > 0 && canvas.text_width(word.substr(0, next)) > width) break;
    fitting = next;
  }
  return fitting;
}

}  // namespace

Canvas::Canvas(int width, int height, double scale)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height)), pen_(cairo_create(surface_)) {
  cairo_scale(pen_, scale, scale);
  settle_font_options(pen_);
}

Canvas::~Canvas() {
  cairo_destroy(pen_);
  cairo_surface_destroy(surface_);
}

void Canvas::set_font(double size, bool bold) {
  cairo_select_font_face(pen_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(pen_, size);
}

double Canvas::text_width(const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(pen_, one_line(text).c_str(), &extents);
  return extents.x_advance;
}

std::vector<std::string> Canvas::lines_of(const std::string& text, double width, std::size_t most) {
  std::vector<std::string> lines;
  const std::string words = one_line(text);
  if (!words.empty() && text_width(words) <= width) return {words};
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    std::string word = words.substr(begin, end - begin);
    begin = end + 1;
    if (word.empty()) continue;
    if (!lines.empty() && text_width(lines.back() + " " + word) <= width) {
      lines.back() += " " + word;
      continue;
    }
    for (std::size_t fitting; (fitting = bytes_within(*this, word, width)) < word.size(); word.erase(0, fitting))
      lines.push_back(word.substr(0, fitting));
    lines.push_back(std::move(word));
  }
  if (lines.size() > most) {
    lines.resize(most);
    const std::size_t fitting = bytes_within(*this, lines.back(), width - text_width("…"));
    lines.back() = lines.back().substr(0, fitting) + "…";
  }
  return lines;
}

void Canvas::write(const std::string& text, double x, double baseline, double align, double ink) {
  cairo_set_source_rgb(pen_, ink, ink, ink);
  cairo_move_to(pen_, x - align * text_width(text), baseline);
  cairo_show_text(pen_, one_line(text).c_str());
}

void Canvas::fill_rectangle(double x, double y, double width, double height, double grey) {
  cairo_set_source_rgb(pen_, grey, grey, grey);
  cairo_rectangle(pen_, x, y, width, height);
  cairo_fill(pen_);
}

void Canvas::draw_line(double x0, double y0, double x1, double y1, double grey) {
  cairo_set_source_rgb(pen_, grey, grey, grey);
  cairo_set_line_width(pen_, 1.0);
  cairo_move_to(pen_, x0, y0);
  cairo_line_to(pen_, x1, y1);
  cairo_stroke(pen_);
}

void Canvas::place(const Image& image, double x, double y, double width, double height, bool smooth) {
  const int stride = cairo_format_stride_for_width(CAIRO_FORMAT_RGB24, image.width);
  std::vector<std::uint32_t> words = words_of(image, stride);
  cairo_surface_t* picture = cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(words.data()),
                                                                 CAIRO_FORMAT_RGB24, image.width, image.height, stride);
  cairo_save(pen_);
  cairo_translate(pen_, x, y);
  cairo_scale(pen_, width / image.width, height / image.height);
  cairo_set_source_surface(pen_, picture, 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(pen_), smooth ? CAIRO_FILTER_GOOD : CAIRO_FILTER_NEAREST);
  cairo_pattern_set_extend(cairo_get_source(pen_), CAIRO_EXTEND_PAD);  // no fading at the picture's edges
  cairo_rectangle(pen_, 0.0, 0.0, image.width, image.height);
  cairo_fill(pen_);
  cairo_restore(pen_);
  cairo_surface_destroy(picture);
}

Image Canvas::rgba() const {
  if (const cairo_status_t status = cairo_status(pen_); status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(fmt::format("a picture cannot be drawn: {}", cairo_status_to_string(status)));
  Image image(cairo_image_surface_get_width(surface_), cairo_image_surface_get_height(surface_), 4);
  cairo_surface_flush(surface_);
  for (int y = 0; y < image.height; ++y) {
    const unsigned char* line = cairo_image_surface_get_data(surface_) + y * cairo_image_surface_get_stride(surface_);
    const auto* words = reinterpret_cast<const std::uint32_t*>(line);
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 4; ++c)
        image.row(y)[4 * x + c] = static_cast<std::uint8_t>(words[x] >> (c < 3 ? 16 - 8 * c : 24));
  }
  return image;
}

Image on_white(const Image& rgba) {
  Image image(rgba.width, rgba.height);
  for (std::size_t pixel = 0; pixel < image.pixels.size() / 3; ++pixel)
    for (int c = 0; c < 3; ++c)
      image.pixels[3 * pixel + c] =
          static_cast<std::uint8_t>(rgba.pixels[4 * pixel + c] + (255 - rgba.pixels[4 * pixel + 3]));
  return image;
}

}  // namespace billow::render
