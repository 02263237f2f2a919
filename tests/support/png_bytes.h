// PNG files written byte by byte: every kind that the format allows, and damaged ones.
#pragma once

#include <cstdint>
#include <string>

namespace billow::test {

/// How a PNG file keeps its pixels.
struct PngLayout {
  int width = 1, height = 1;
  int depth = 8;                 // bits per channel
  int colour_type = 2;           // 0 grey, 2 RGB, 3 palette, 4 grey + alpha, 6 RGBA
  int interlace = 0;             // 1: Adam7, whose rows are those of seven smaller images
  std::string palette = {};      // PLTE
  std::string transparent = {};  // tRNS
};

/// A chunk: length, type, data, checksum.
std::string png_chunk(const std::string& type, const std::string& data);

/// A whole file. `rows` holds the packed bytes of all rows, without filter bytes.
std::string png_bytes(const PngLayout& layout, const std::string& rows);

}  // namespace billow::test
