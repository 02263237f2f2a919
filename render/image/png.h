// PNG files in and out. png.cpp is the only file that knows libpng.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/atomic_file.h"
#include "render/image/image.h"

namespace billow::render {

class PngSource;

/// Reads an 8-bit RGB or RGBA image (palette, grey and 16-bit files are converted).
/// Throws InputError on a file that is missing, no regular file, damaged, or larger than 8192 x 8192. Takes no more
/// memory than its pixels do: what else is in the file is skipped.
Image read_png(const std::filesystem::path& file);

/// What becomes of values of 16 bits: they are rounded to 8, or stay as they are.
enum class PngDepth { eight, own };

/// The same image row by row from the top, for images too large to hold; only interlaced ones are held.
class PngRows {
 public:
  /// Throws as read_png.
  explicit PngRows(const std::filesystem::path& file, PngDepth depth = PngDepth::eight);
  ~PngRows();
  int width() const;
  int height() const;
  int channels() const;
  /// Of a value: 8, or 16 where the file has such and they stay.
  int bits() const;
  /// The next of height() rows of width() * channels() values, of 16 bits the higher byte first, which stay until the
  /// next call. Throws InputError where the file is damaged.
  const std::uint8_t* next();

 private:
  std::unique_ptr<PngSource> source_;
  std::vector<std::uint8_t> row_;
};

/// As read_png, of the bytes of a file; `name` stands for it in messages.
Image decode_png(std::string_view bytes, const std::string& name);

/// How many pixels the header of such bytes claims; 0 where they have none.
std::size_t claimed_png_pixels(std::string_view bytes);

/// Writes `image` whole or not at all (AtomicFile). The same pixels give the same bytes.
/// Throws OutputError, leaving neither file, when anything fails.
void write_png(const std::filesystem::path& file, const Image& image);
/// As 16-bit grey, the notes as text.
void write_png(const std::filesystem::path& file, const Image16& image);

/// The bytes of the file that write_png would write.
std::string encode_png(const Image& image);

/// As write_png, for images too large to hold: `fill_row(y, row)` is asked for one row of pixels after another.
void write_png_rows(const std::filesystem::path& file, int width, int height, int channels,
                    const std::function<void(int y, std::uint8_t* row)>& fill_row);

}  // namespace billow::render
