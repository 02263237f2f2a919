// PNG files in and out. The only file that knows libpng.
#pragma once

#include <filesystem>
#include <functional>

#include "render/image.h"

namespace billow::render {

/// Reads an 8-bit RGB or RGBA image (palette, grey and 16-bit files are converted).
/// Throws InputError on a file that is missing, damaged, or larger than 8192 x 8192.
Image read_png(const std::filesystem::path& file);

/// Writes `image` whole or not at all: a temporary file beside `file`, checked write and close, then rename.
/// Throws OutputError, leaving neither file, when anything fails.
void write_png(const std::filesystem::path& file, const Image& image);

/// As write_png, for images too large to hold: `fill_row(y, row)` is asked for one row of pixels after another.
void write_png_rows(const std::filesystem::path& file, int width, int height, int channels,
                    const std::function<void(int y, std::uint8_t* row)>& fill_row);

/// Writes any bytes whole or not at all, by the same rule.
void write_file_atomically(const std::filesystem::path& file, const std::string& contents);

}  // namespace billow::render
