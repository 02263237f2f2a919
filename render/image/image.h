// An 8-bit image in memory.
#pragma once

#include <cstdint>
#include <vector>

namespace billow::render {

/// Interleaved 8-bit pixels, rows from the top, no padding. 3 channels are RGB, 4 RGBA; sRGB-encoded.
struct Image {
  int width = 0, height = 0, channels = 3;
  std::vector<std::uint8_t> pixels;  // (height * width * channels)

  Image() = default;
  Image(int w, int h, int c = 3) : width(w), height(h), channels(c), pixels(std::size_t(w) * h * c) {}
  std::uint8_t* row(int y) { return pixels.data() + std::size_t(y) * width * channels; }
  const std::uint8_t* row(int y) const { return pixels.data() + std::size_t(y) * width * channels; }
};

}  // namespace billow::render
