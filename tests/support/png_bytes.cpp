// PNG and zlib containers around uncompressed data.
#include "tests/support/png_bytes.h"

namespace billow::test {
namespace {

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const unsigned char byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

std::uint32_t adler32(const std::string& bytes) {
  std::uint32_t a = 1, b = 0;
  for (const unsigned char byte : bytes) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

// One stored block, so at most 65535 bytes.
std::string zlib_stored(const std::string& data) {
  const auto size = static_cast<std::uint16_t>(data.size());
  std::string bytes = "\x78\x01\x01";
  for (const int value : {size & 0xff, size >> 8, ~size & 0xff, ~size >> 8 & 0xff}) bytes += static_cast<char>(value);
  return bytes + data + big_endian(adler32(data));
}

int channels(int colour_type) { return colour_type == 2 ? 3 : colour_type == 4 ? 2 : colour_type == 6 ? 4 : 1; }

std::string header(const PngLayout& layout) {
  std::string data =
      big_endian(static_cast<std::uint32_t>(layout.width)) + big_endian(static_cast<std::uint32_t>(layout.height));
  for (const int value : {layout.depth, layout.colour_type, 0, 0, layout.interlace}) data += static_cast<char>(value);
  return data;
}

}  // namespace

std::string png_chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc32(type + data));
}

std::string png_bytes(const PngLayout& layout, const std::string& rows) {
  const std::size_t bits = std::size_t(layout.width) * layout.depth * channels(layout.colour_type);
  const std::size_t stride = (bits + 7) / 8;
  std::string filtered;
  for (int y = 0; y < layout.height; ++y) filtered += '\0' + rows.substr(y * stride, stride);
  std::string bytes = "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header(layout));
  if (!layout.palette.empty()) bytes += png_chunk("PLTE", layout.palette);
  if (!layout.transparent.empty()) bytes += png_chunk("tRNS", layout.transparent);
  return bytes + png_chunk("IDAT", zlib_stored(filtered)) + png_chunk("IEND", "");
}

}  // namespace billow::test
