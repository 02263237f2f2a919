// Attribute by attribute, by "OpenEXR File Layout": a name, a type, a size and a value each, integers little-endian.
#include "render/image/exr_header.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <string_view>

namespace billow::render {

namespace {

constexpr std::string_view exr_mark("\x76\x2f\x31\x01", 4);
constexpr unsigned several_parts = 0x1000;  // of the version's flags

// Types whose size is always the same, by which OpenEXR reads them whatever size the file says.
std::optional<std::int64_t> size_of_type(std::string_view type) {
  static const std::map<std::string_view, std::int64_t> sizes = {
      {"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
      {"compression", 1}, {"double", 8},   {"envmap", 1},
      {"float", 4},       {"int", 4},      {"keycode", 28},
      {"lineOrder", 1},   {"m33f", 36},    {"m33d", 72},
      {"m44f", 64},       {"m44d", 128},   {"rational", 8},
      {"tiledesc", 9},    {"timecode", 8}, {"v2i", 8},
      {"v2f", 8},         {"v2d", 16},     {"v3i", 12},
      {"v3f", 12},        {"v3d", 24},     {"deepImageState", 1}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? std::nullopt : std::optional(found->second);
}

/// The file from its beginning to its end, and no further.
class HeaderBytes {
 public:
  explicit HeaderBytes(const std::filesystem::path& file)
      : in_(file, std::ios::binary), left_(static_cast<std::int64_t>(std::filesystem::file_size(file))) {}

  bool skip(std::int64_t bytes) {
    if (bytes < 0 || bytes > left_) return false;
    in_.seekg(bytes, std::ios::cur);
    left_ -= bytes;
    return static_cast<bool>(in_);
  }

  std::optional<std::int64_t> integer() {
    std::array<unsigned char, 4> bytes = {};
    if (left_ < 4 || !in_.read(reinterpret_cast<char*>(bytes.data()), bytes.size())) return std::nullopt;
    left_ -= 4;
    const std::uint32_t value =
        bytes[0] | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 | std::uint32_t{bytes[3]} << 24;
    return static_cast<std::int32_t>(value);
  }

  /// Up to a zero byte, which is read too. OpenEXR's names have at most 255 bytes.
  std::optional<std::string> text() {
    std::string read;
    for (char byte = 0; read.size() < 256 && left_ > 0 && in_.get(byte); read += byte) {
      --left_;
      if (byte == '\0') return read;
    }
    return std::nullopt;
  }

  std::int64_t left() const { return left_; }

 private:
  std::ifstream in_;
  std::int64_t left_;  // [byte]
};

// Channels up to an empty name: a type, a flag with room, and two distances each.
bool channels_fill(HeaderBytes& bytes, std::int64_t size) {
  const std::int64_t end = bytes.left() - size;
  while (const auto name = bytes.text()) {
    if (name->empty()) return bytes.left() == end;
    if (!bytes.skip(16) || bytes.left() < end) return false;
  }
  return false;
}

// A length and as many bytes each.
bool texts_fill(HeaderBytes& bytes, std::int64_t size) {
  const std::int64_t end = bytes.left() - size;
  while (bytes.left() > end) {
    const auto length = bytes.integer();
    if (!length || !bytes.skip(*length)) return false;
  }
  return bytes.left() == end;
}

// Two sides, and four bytes for each pixel.
bool preview_fills(HeaderBytes& bytes, std::int64_t size) {
  const auto width = bytes.integer(), height = bytes.integer();
  if (!width || !height || *width < 0 || *height < 0 || *width > size || *height > size) return false;
  return *width * *height * 4 == size - 8 && bytes.skip(size - 8);
}

bool value_fits(HeaderBytes& bytes, std::string_view type, std::int64_t size) {
  if (size < 0 || size > bytes.left()) return false;
  if (type == "chlist") return channels_fill(bytes, size);
  if (type == "stringvector") return texts_fill(bytes, size);
  if (type == "preview") return preview_fills(bytes, size);
  return size == size_of_type(type).value_or(size) && bytes.skip(size);
}

enum class PartHeader { whole, empty, broken };

// Up to the empty name that ends it; one that begins with it ends the list of parts.
PartHeader read_part_header(HeaderBytes& bytes) {
  for (bool empty = true;; empty = false) {
    const auto name = bytes.text();
    if (!name) return PartHeader::broken;
    if (name->empty()) return empty ? PartHeader::empty : PartHeader::whole;
    const auto type = bytes.text();
    const auto size = type ? bytes.integer() : std::nullopt;
    if (!size || !value_fits(bytes, *type, *size)) return PartHeader::broken;
  }
}

}  // namespace

std::optional<std::string> exr_header_fault(const std::filesystem::path& file) {
  HeaderBytes bytes(file);
  if (bytes.left() == 0) return "is empty";
  std::string mark(exr_mark.size(), '\0');
  std::ifstream(file, std::ios::binary).read(mark.data(), static_cast<std::streamsize>(mark.size()));
  if (mark != exr_mark) return "is no OpenEXR image";
  bytes.skip(static_cast<std::int64_t>(exr_mark.size()));
  const auto version = bytes.integer();
  if (!version) return "is cut short";
  PartHeader part = read_part_header(bytes);
  while ((*version & several_parts) != 0 && part == PartHeader::whole) part = read_part_header(bytes);
  const bool ended = part == ((*version & several_parts) != 0 ? PartHeader::empty : PartHeader::whole);
  return ended ? std::nullopt : std::optional<std::string>("is damaged: its header does not add up");
}

}  // namespace billow::render
