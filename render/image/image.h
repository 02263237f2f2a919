// Images in memory: colours of 8 bits, grey of 16, and channels of numbers.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
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

/// Notes that a file keeps beside its pixels: keyword, text.
using ImageNotes = std::vector<std::pair<std::string, std::string>>;

/// Grey 16-bit pixels, rows from the top, no padding. Numbers, not light.
struct Image16 {
  int width = 0, height = 0;
  std::vector<std::uint16_t> pixels;  // (height * width)
  ImageNotes notes = {};
};

/// Channels of numbers on one grid of pixels.
struct DataImage {
  struct Channel {
    std::string name;          // as OpenEXR writes it: LAYER.COMPONENT, or R, G, B, A, Z
    std::vector<float> value;  // (height * width) rows from the top
  };
  int width = 0, height = 0;
  std::vector<Channel> channels;
  ImageNotes notes = {};
};

}  // namespace billow::render
