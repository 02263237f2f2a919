// A page to draw and write on: cairo, with the one font that all pictures use. Its text is the same on every machine.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/image/image.h"

struct _cairo;
struct _cairo_surface;

namespace billow::render {

class Canvas {
 public:
  /// Transparent, width x height pixels, in units of 1/scale pixel. Throws std::runtime_error when cairo cannot.
  Canvas(int width, int height, double scale = 1.0);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  _cairo* pen() { return pen_; }
  void set_font(double size, bool bold = false);
  double text_width(const std::string& text);
  /// `text` in lines no wider than `width`, broken at blanks, and within words that are wider alone. At most `most`
  /// lines: what does not fit ends with an ellipsis. None of an empty text.
  std::vector<std::string> lines_of(const std::string& text, double width, std::size_t most = 1000);
  /// In ink of grey `ink`. `align`: 0 starts at x, 1/2 is centred on it, 1 ends there.
  void write(const std::string& text, double x, double baseline, double align, double ink = 0.16);
  void fill_rectangle(double x, double y, double width, double height, double grey);
  /// One unit wide.
  void draw_line(double x0, double y0, double x1, double y1, double grey);
  /// `image` (RGB) stretched over the rectangle; `smooth` filters, otherwise pixels stay sharp squares.
  void place(const Image& image, double x, double y, double width, double height, bool smooth);

  /// Premultiplied RGBA. Throws std::runtime_error when drawing has failed.
  Image rgba() const;

 private:
  _cairo_surface* surface_;
  _cairo* pen_;
};

/// Over white, without alpha.
Image on_white(const Image& rgba);

}  // namespace billow::render
