// PNG (ISO 15948): a signature, then chunks from IHDR to IEND, each with a CRC of its type and data.
#include "render/image/png_fault.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "render/image/big_endian.h"

namespace billow::render {
namespace {

constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";

/// A file's chunks, one after another.
class Chunks {
 public:
  explicit Chunks(std::FILE* stream) : stream_(stream) {}

  bool at_end() const {
    const int next = std::getc(stream_);
    return next == EOF || std::ungetc(next, stream_) == EOF;
  }
  bool begins_as_png() { return read(signature.size()) && std::memcmp(piece_.data(), signature.data(), 8) == 0; }

  /// Goes through the next one. False where the file ends before it does.
  bool next() {
    if (!read(8)) return false;
    length_ = big_endian(piece_.data());
    type_.assign(piece_.begin() + 4, piece_.begin() + 8);
    uLong checksum = crc32(0, piece_.data() + 4, 4);
    for (std::size_t left = length_, size = 0; left > 0; left -= size) {
      size = std::min(left, piece_.size());
      if (!read(size)) return false;
      checksum = crc32(checksum, piece_.data(), static_cast<uInt>(size));
    }
    unsigned char stored[4];
    if (std::fread(stored, 1, sizeof stored, stream_) != sizeof stored) return false;
    sound_ = checksum == big_endian(stored);
    return true;
  }
  /// Of the one that was gone through.
  bool sound() const { return sound_; }
  bool is(std::string_view type) const { return type_ == type; }
  std::uint32_t length() const { return length_; }
  /// Number `k` of four bytes each; of the last 64 KiB.
  std::uint32_t number(int k) const { return big_endian(piece_.data() + 4 * k); }

 private:
  bool read(std::size_t size) { return std::fread(piece_.data(), 1, size, stream_) == size; }

  std::FILE* stream_;
  std::vector<unsigned char> piece_ = std::vector<unsigned char>(std::size_t{1} << 16);
  std::uint32_t length_ = 0;
  std::string type_;
  bool sound_ = false;
};

std::optional<std::string> header_fault(const Chunks& header, int width, int height) {
  if (!header.is("IHDR") || header.length() != 13) return "is damaged: it has no header";
  const std::uint32_t has_width = header.number(0), has_height = header.number(1);
  if (has_width == static_cast<std::uint32_t>(width) && has_height == static_cast<std::uint32_t>(height))
    return std::nullopt;
  return fmt::format("has {} x {} pixels instead of {} x {}", has_width, has_height, width, height);
}

}  // namespace

std::optional<std::string> png_fault(const std::filesystem::path& file, int width, int height) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), std::fclose);
  if (!stream) return fmt::format("cannot be read: {}", std::strerror(errno));
  Chunks chunks(stream.get());
  if (chunks.at_end()) return "is empty";
  if (!chunks.begins_as_png()) return "is not a PNG image";
  for (bool first = true; first || !chunks.is("IEND"); first = false) {
    if (!chunks.next()) return "is cut short";
    if (!chunks.sound()) return "is damaged: a checksum is wrong";
    if (!first) continue;
    if (const auto fault = header_fault(chunks, width, height)) return fault;
  }
  if (!chunks.at_end()) return "is damaged: it goes on after the image's end";
  return std::nullopt;
}

}  // namespace billow::render
