// The only file that knows libjpeg, whose errors become exceptions before they cross a C++ frame.
#include "render/image/texture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <fstream>
#include <iterator>

#include <jpeglib.h>

#include "base/error.h"
#include "render/image/png.h"

namespace billow::render {
namespace {

constexpr unsigned max_size = 8192;  // [pixel] either way
// A progressive image keeps its coefficients until its last scan: two bytes for each of three colours, and some more.
constexpr long max_jpeg_bytes = 512L << 20;
constexpr int max_scans = 100;  // of a progressive image; each goes over the whole image, however little it changes
constexpr std::uintmax_t max_file_bytes = std::uintmax_t{1} << 28;

struct JpegErrors {
  jpeg_error_mgr manager;  // first: libjpeg hands out its address
  std::jmp_buf jump;
  char message[JMSG_LENGTH_MAX];
};

[[noreturn]] void on_error(j_common_ptr jpeg) {
  auto* errors = reinterpret_cast<JpegErrors*>(jpeg->err);
  (*jpeg->err->format_message)(jpeg, errors->message);
  std::longjmp(errors->jump, 1);
}

// A file that ends early is only warned of.
void on_message(j_common_ptr jpeg, int level) {
  if (level < 0) on_error(jpeg);
}

// Asked many times a scan.
void check_scans(j_common_ptr jpeg) {
  if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= max_scans) return;
  auto* errors = reinterpret_cast<JpegErrors*>(jpeg->err);
  *fmt::format_to_n(errors->message, sizeof errors->message - 1, "it has more than {} scans", max_scans).out = '\0';
  std::longjmp(errors->jump, 1);
}

struct Jpeg {
  Jpeg() {
    decoder.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = on_error;
    errors.manager.emit_message = on_message;
    jpeg_create_decompress(&decoder);
    decoder.mem->max_memory_to_use = max_jpeg_bytes;
    decoder.progress = &progress;
  }
  ~Jpeg() { jpeg_destroy_decompress(&decoder); }
  Jpeg(const Jpeg&) = delete;

  jpeg_decompress_struct decoder;
  jpeg_progress_mgr progress = {check_scans, 0, 0, 0, 0};
  JpegErrors errors;
};

// `calls` must own nothing: a jump skips destructors.
template <class Calls>
void run(Jpeg& jpeg, const std::string& name, const Calls& calls) {
  if (setjmp(jpeg.errors.jump))
    throw InputError(fmt::format("{}: the JPEG image is damaged: {}", name, jpeg.errors.message));
  calls();
}

void read_header(Jpeg& jpeg, std::string_view bytes, const std::string& name) {
  run(jpeg, name, [&] {
    jpeg_mem_src(&jpeg.decoder, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&jpeg.decoder, TRUE);
  });
}

bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8\xff"); }

Image decode_jpeg(std::string_view bytes, const std::string& name) {
  Jpeg jpeg;
  read_header(jpeg, bytes, name);
  if (jpeg.decoder.image_width > max_size || jpeg.decoder.image_height > max_size)
    throw InputError(fmt::format("{}: the image has {} x {} pixels; at most {} x {} are read", name,
                                 jpeg.decoder.image_width, jpeg.decoder.image_height, max_size, max_size));
  if (jpeg.decoder.num_components == 4)
    throw InputError(fmt::format("{}: the JPEG image is in CMYK, for print; save it in RGB", name));
  jpeg.decoder.out_color_space = JCS_RGB;
  Image image(static_cast<int>(jpeg.decoder.image_width), static_cast<int>(jpeg.decoder.image_height));
  run(jpeg, name, [&] {
    jpeg_start_decompress(&jpeg.decoder);
    while (jpeg.decoder.output_scanline < jpeg.decoder.output_height) {
      JSAMPROW row = image.row(static_cast<int>(jpeg.decoder.output_scanline));
      jpeg_read_scanlines(&jpeg.decoder, &row, 1);
    }
    jpeg_finish_decompress(&jpeg.decoder);
  });
  return image;
}

}  // namespace

Image decode_texture(std::string_view bytes, const std::string& name) {
  if (is_jpeg(bytes)) return decode_jpeg(bytes, name);
  if (bytes.starts_with("\x89PNG") || bytes.empty()) return decode_png(bytes, name);
  throw InputError(fmt::format("{}: is neither a PNG nor a JPEG image; convert it to one of these", name));
}

std::size_t claimed_pixels(std::string_view bytes) {
  if (!is_jpeg(bytes)) return claimed_png_pixels(bytes);
  try {
    Jpeg jpeg;
    read_header(jpeg, bytes, "it");
    return std::size_t{jpeg.decoder.image_width} * jpeg.decoder.image_height;
  } catch (const InputError&) {
    return 0;  // decoding it fails at once, too
  }
}

Image read_texture(const std::filesystem::path& file) {
  std::error_code error;
  // What is missing, empty or no regular file read_png has words for.
  if (!std::filesystem::is_regular_file(file, error)) return read_png(file);
  if (std::filesystem::file_size(file, error) > max_file_bytes)
    throw InputError(
        fmt::format("{}: larger than {} MiB; save the image smaller", file.string(), max_file_bytes >> 20));
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  return bytes.empty() ? read_png(file) : decode_texture(bytes, file.string());
}

bool has_alpha(const Image& image) {
  if (image.channels != 4) return false;
  for (std::size_t k = 3; k < image.pixels.size(); k += 4)
    if (image.pixels[k] != 255) return true;
  return false;
}

// Wave by wave: a pixel takes the mean of the neighbours that have a colour before it.
void bleed_into_holes(Image& image) {
  if (image.channels != 4) return;
  const int w = image.width, h = image.height;
  std::vector<bool> coloured(std::size_t(w) * h);
  for (std::size_t p = 0; p < coloured.size(); ++p) coloured[p] = image.pixels[4 * p + 3] != 0;
  const auto around = [&](std::size_t p, const auto& visit) {
    const int x = static_cast<int>(p % w), y = static_cast<int>(p / w);
    if (x > 0) visit(p - 1);
    if (x + 1 < w) visit(p + 1);
    if (y > 0) visit(p - w);
    if (y + 1 < h) visit(p + w);
  };
  std::vector<std::size_t> wave;
  std::vector<bool> queued = coloured;
  const auto queue_around = [&](std::size_t p) {
    around(p, [&](std::size_t q) {
      if (!queued[q]) queued[q] = true, wave.push_back(q);
    });
  };
  for (std::size_t p = 0; p < coloured.size(); ++p)
    if (coloured[p]) queue_around(p);
  while (!wave.empty()) {
    const std::vector<std::size_t> now = std::move(wave);
    wave.clear();
    for (const std::size_t p : now) {
      int sum[3] = {}, count = 0;
      around(p, [&](std::size_t q) {
        if (!coloured[q]) return;
        for (int c = 0; c < 3; ++c) sum[c] += image.pixels[4 * q + c];
        ++count;
      });
      for (int c = 0; c < 3; ++c) image.pixels[4 * p + c] = static_cast<std::uint8_t>(sum[c] / count);
    }
    for (const std::size_t p : now) coloured[p] = true;
    for (const std::size_t p : now) queue_around(p);
  }
}

Image with_alpha(const Image& image, const Image& grey) {
  Image result(image.width, image.height, 4);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* from = image.row(y) + image.channels * x;
      const int grey_x = x * grey.width / image.width, grey_y = y * grey.height / image.height;
      const std::uint8_t* alpha = grey.row(grey_y) + grey.channels * grey_x;
      std::uint8_t* to = result.row(y) + 4 * x;
      std::copy_n(from, 3, to);
      to[3] = static_cast<std::uint8_t>((alpha[0] + alpha[1] + alpha[2] + 1) / 3);
    }
  return result;
}

}  // namespace billow::render
