// libpng, with its longjmps turned into exceptions before they cross a C++ frame.
#include "render/image/png.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cerrno>
#include <csetjmp>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "render/image/big_endian.h"

namespace billow::render {
namespace {

constexpr int max_read_size = 8192;           // [pixel] either way: a hostile header must not claim all memory
constexpr std::uintmax_t most_packed = 1032;  // bytes that deflate can make one of
constexpr int max_write_size = 0x7fffffff;

// libpng calls this instead of returning; the text outlives the jump.
[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  std::longjmp(png_jmpbuf(png), 1);
}

void on_warning(png_structp, png_const_charp) {}

// Runs libpng calls; false when one of them failed. `calls` must own nothing: a jump skips destructors.
template <typename Calls>
bool succeeds(png_structp png, const Calls& calls) {
  if (setjmp(png_jmpbuf(png))) return false;
  calls();
  return true;
}

struct PngReader {
  PngReader() : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &message, on_error, on_warning)) {
    if (!png) throw std::bad_alloc();
    info = png_create_info_struct(png);
    if (!info) throw std::bad_alloc();
  }
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
  PngReader(const PngReader&) = delete;

  std::string message;
  png_structp png;
  png_infop info = nullptr;
};

struct PngWriter {
  PngWriter() : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, on_error, on_warning)) {
    if (!png) throw std::bad_alloc();
    info = png_create_info_struct(png);
    if (!info) throw std::bad_alloc();
  }
  ~PngWriter() { png_destroy_write_struct(&png, &info); }
  PngWriter(const PngWriter&) = delete;

  std::string message;
  png_structp png;
  png_infop info = nullptr;
};

using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason) {
  throw InputError(fmt::format("{}: {}", file.string(), reason));
}

// What is no file is refused unopened: a pipe would be waited for.
Stream open_to_read(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status)) refuse(file, "is a folder, not a PNG image");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    refuse(file, "is not a regular file, so it is not read as an image; save it as one");
  Stream stream(std::fopen(file.c_str(), "rb"), std::fclose);
  if (!stream) refuse(file, fmt::format("cannot open the image: {}", std::strerror(errno)));
  return stream;
}

std::uintmax_t bytes_of(std::FILE* stream) {
  const long size = std::fseek(stream, 0, SEEK_END) == 0 ? std::ftell(stream) : -1;
  return size < 0 ? 0 : static_cast<std::uintmax_t>(size);
}

// Unpacked; of a colour type that there is not, as for the largest.
std::uintmax_t pixel_bytes(std::uintmax_t width, std::uintmax_t height, unsigned depth, unsigned colour_type) {
  const unsigned samples = colour_type == PNG_COLOR_TYPE_GRAY || colour_type == PNG_COLOR_TYPE_PALETTE ? 1
                           : colour_type == PNG_COLOR_TYPE_GRAY_ALPHA                                  ? 2
                           : colour_type == PNG_COLOR_TYPE_RGB                                         ? 3
                                                                                                       : 4;
  return (width * samples * depth + 7) / 8 * height;
}

// Signature and size are checked here because libpng's own words for them do not help a user.
void check_header(const std::filesystem::path& file, std::FILE* stream) {
  png_byte header[26] = {};
  const std::size_t got = std::fread(header, 1, sizeof header, stream);
  if (got == 0) refuse(file, "the image is empty");
  if (png_sig_cmp(header, 0, std::min<std::size_t>(got, 8)) != 0) refuse(file, "is not a PNG image");
  if (got < sizeof header) refuse(file, "the PNG image is cut short");
  const std::uint32_t width = big_endian(header + 16), height = big_endian(header + 20);
  if (width > max_read_size || height > max_read_size)
    refuse(file, fmt::format("the image has {} x {} pixels; at most {} x {} are read", width, height, max_read_size,
                             max_read_size));
  if (pixel_bytes(width, height, header[24], header[25]) / most_packed > bytes_of(stream))
    refuse(file, fmt::format("the PNG image is cut short: {} x {} pixels do not fit in it", width, height));
  std::rewind(stream);
}

// Everything becomes RGB, or RGBA where the file has transparency.
void read_header(PngReader& reader, std::FILE* stream, PngDepth depth) {
  png_structp png = reader.png;
  png_init_io(png, stream);
  png_set_user_limits(png, max_read_size, max_read_size);
  // All but pixels, palette and transparency is skipped: a text or a colour profile may claim gigabytes, or unpack to
  // them, and libpng only warns of those above its limits.
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_read_info(png, reader.info);
  png_set_expand(png);
  if (depth == PngDepth::eight) png_set_scale_16(png);
  png_set_gray_to_rgb(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, reader.info);
}

// Where the bytes of a PNG go. False, with errno set, when they cannot be kept.
using Sink = std::function<bool(const void* bytes, std::size_t size)>;
using FillRow = std::function<void(int y, std::uint8_t* row)>;

void write_chunk(png_structp png, png_bytep bytes, png_size_t size) {
  if (!(*static_cast<Sink*>(png_get_io_ptr(png)))(bytes, size)) png_error(png, "write");
}

struct PixelFormat {
  int bits, colour_type;
  std::size_t row_bytes;
  bool srgb;  // colours, rather than numbers
  std::span<png_text> notes = {};
};

// Measured on frames: level 2 with UP or SUB takes a third of the time of level 6 with all filters, for files hardly
// larger. No time chunk, so that the same pixels give the same bytes.
void write_header(PngWriter& writer, Sink& output, int width, int height, const PixelFormat& format) {
  png_structp png = writer.png;
  png_set_write_fn(png, &output, write_chunk, [](png_structp) {});
  png_set_user_limits(png, max_write_size, max_write_size);
  png_set_compression_level(png, 2);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
  png_set_IHDR(png, writer.info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), format.bits,
               format.colour_type, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (format.srgb) png_set_sRGB(png, writer.info, PNG_sRGB_INTENT_PERCEPTUAL);
  for (const png_text& note : format.notes) png_set_text(png, writer.info, &note, 1);
  png_write_info(png, writer.info);
}

// False when a call of libpng failed; writer.message then says why.
bool encode(PngWriter& writer, Sink& output, int width, int height, const PixelFormat& format,
            const FillRow& fill_row) {
  if (!succeeds(writer.png, [&] { write_header(writer, output, width, height, format); })) return false;
  std::vector<std::uint8_t> row(format.row_bytes);
  for (int y = 0; y < height; ++y) {
    fill_row(y, row.data());
    if (!succeeds(writer.png, [&] { png_write_row(writer.png, row.data()); })) return false;
  }
  return succeeds(writer.png, [&] { png_write_end(writer.png, nullptr); });
}

PixelFormat format_of(int width, int channels) {
  return {8, channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, std::size_t(width) * channels, true};
}

FillRow rows_of(const Image& image) {
  return
      [&image](int y, std::uint8_t* row) { std::memcpy(row, image.row(y), std::size_t(image.width) * image.channels); };
}

// A failed write leaves its reason in errno; anything else is libpng's own complaint.
[[noreturn]] void fail(const PngWriter& writer, const AtomicFile& output, const std::filesystem::path& file) {
  if (writer.message == "write") output.fail();
  throw OutputError(fmt::format("cannot write {}: {}", file.string(), writer.message));
}

void write_rows(const std::filesystem::path& file, int width, int height, const PixelFormat& format,
                const FillRow& fill_row) {
  AtomicFile output(file);
  Sink sink = [&](const void* bytes, std::size_t size) { return output.write(bytes, size); };
  PngWriter writer;
  if (!encode(writer, sink, width, height, format, fill_row)) fail(writer, output, file);
  output.commit();
}

}  // namespace

/// A PNG file that is being read.
class PngSource {
 public:
  PngSource(Stream stream, std::filesystem::path file, PngDepth depth = PngDepth::eight)
      : file_(std::move(file)), stream_(std::move(stream)) {
    check_header(file_, stream_.get());
    check(succeeds(reader_.png, [&] { read_header(reader_, stream_.get(), depth); }));
    width = static_cast<int>(png_get_image_width(reader_.png, reader_.info));
    height = static_cast<int>(png_get_image_height(reader_.png, reader_.info));
    channels = static_cast<int>(png_get_channels(reader_.png, reader_.info));
    bits = png_get_bit_depth(reader_.png, reader_.info);
    if (png_get_interlace_type(reader_.png, reader_.info) == PNG_INTERLACE_NONE) return;
    held_.resize(row_bytes() * height);
    std::vector<png_bytep> rows;
    for (int y = 0; y < height; ++y) rows.push_back(held_.data() + row_bytes() * y);
    check(succeeds(reader_.png, [&] { png_read_image(reader_.png, rows.data()); }));
  }

  void read(std::uint8_t* row) {
    if (!held_.empty())
      std::copy_n(held_.data() + row_bytes() * next_, row_bytes(), row);
    else
      check(succeeds(reader_.png, [&] { png_read_row(reader_.png, row, nullptr); }));
    if (++next_ == height) check(succeeds(reader_.png, [&] { png_read_end(reader_.png, nullptr); }));
  }

  std::size_t row_bytes() const { return std::size_t(width) * channels * (bits / 8); }

  int width = 0, height = 0, channels = 0, bits = 8;

 private:
  void check(bool succeeded) const {
    if (!succeeded) refuse(file_, "the PNG image is damaged: " + reader_.message);
  }

  std::filesystem::path file_;
  Stream stream_;
  PngReader reader_;
  std::vector<std::uint8_t> held_;  // all rows of an interlaced file, which come in seven parts
  int next_ = 0;
};

namespace {

Image image_of(PngSource source) {
  Image image(source.width, source.height, source.channels);
  for (int y = 0; y < image.height; ++y) source.read(image.row(y));
  return image;
}

}  // namespace

PngRows::PngRows(const std::filesystem::path& file, PngDepth depth)
    : source_(std::make_unique<PngSource>(open_to_read(file), file, depth)), row_(source_->row_bytes()) {}
PngRows::~PngRows() = default;
int PngRows::width() const { return source_->width; }
int PngRows::height() const { return source_->height; }
int PngRows::channels() const { return source_->channels; }
int PngRows::bits() const { return source_->bits; }

const std::uint8_t* PngRows::next() {
  source_->read(row_.data());
  return row_.data();
}

Image read_png(const std::filesystem::path& file) { return image_of({open_to_read(file), file}); }

Image decode_png(std::string_view bytes, const std::string& name) {
  if (bytes.empty()) refuse(name, "the image is empty");
  // Only read from.
  Stream stream(fmemopen(const_cast<char*>(bytes.data()), bytes.size(), "rb"), std::fclose);
  if (!stream) throw std::bad_alloc();
  return image_of({std::move(stream), name});
}

std::size_t claimed_png_pixels(std::string_view bytes) {
  const auto* header = reinterpret_cast<const png_byte*>(bytes.data());
  if (bytes.size() < 24 || png_sig_cmp(header, 0, 8) != 0) return 0;
  return std::size_t{big_endian(header + 16)} * big_endian(header + 20);
}

void write_png(const std::filesystem::path& file, const Image& image) {
  write_png_rows(file, image.width, image.height, image.channels, rows_of(image));
}

std::string encode_png(const Image& image) {
  std::string bytes;
  Sink sink = [&](const void* more, std::size_t size) {
    bytes.append(static_cast<const char*>(more), size);
    return true;
  };
  PngWriter writer;
  if (!encode(writer, sink, image.width, image.height, format_of(image.width, image.channels), rows_of(image)))
    throw OutputError("cannot encode a PNG image: " + writer.message);
  return bytes;
}

void write_png_rows(const std::filesystem::path& file, int width, int height, int channels,
                    const std::function<void(int y, std::uint8_t* row)>& fill_row) {
  write_rows(file, width, height, format_of(width, channels), fill_row);
}

// PNG puts the high byte first.
void write_png(const std::filesystem::path& file, const Image16& image) {
  std::vector<png_text> notes;
  for (const auto& [keyword, text] : image.notes) {
    png_text& note = notes.emplace_back();
    note.compression = PNG_TEXT_COMPRESSION_NONE;
    note.key = const_cast<char*>(keyword.c_str());
    note.text = const_cast<char*>(text.c_str());
    note.text_length = text.size();
  }
  const PixelFormat format{16, PNG_COLOR_TYPE_GRAY, 2 * std::size_t(image.width), false, notes};
  write_rows(file, image.width, image.height, format, [&](int y, std::uint8_t* row) {
    const std::uint16_t* from = image.pixels.data() + std::size_t(y) * image.width;
    for (int x = 0; x < image.width; ++x) {
      row[2 * x] = static_cast<std::uint8_t>(from[x] >> 8);
      row[2 * x + 1] = static_cast<std::uint8_t>(from[x] & 255);
    }
  });
}

}  // namespace billow::render
