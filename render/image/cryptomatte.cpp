// Hashes, their floats, and the manifest.
#include "render/image/cryptomatte.h"

#include <fmt/format.h>

#include <bit>

namespace billow::render {
namespace {

std::uint32_t scrambled(std::uint32_t block) { return std::rotl(block * 0xcc9e2d51u, 15) * 0x1b873593u; }

std::uint32_t byte_at(std::string_view text, std::size_t place) { return static_cast<unsigned char>(text[place]); }

std::uint32_t finished(std::uint32_t hash) {
  hash = (hash ^ hash >> 16) * 0x85ebca6bu;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
  return hash ^ hash >> 16;
}

std::uint32_t id_bits(std::string_view name) {
  const std::uint32_t bits = murmur3(name), exponent = bits >> 23 & 255u;
  return exponent == 0 || exponent == 255 ? bits ^ 1u << 23 : bits;
}

std::string json_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20;
    if (c == '"' || c == '\\') quoted += '\\';
    if (control)
      quoted += fmt::format("\\u{:04x}", int(c));
    else
      quoted += c;
  }
  return quoted + '"';
}

std::string manifest(const std::vector<std::string>& names) {
  std::string entries;
  for (const std::string& name : names)
    entries += fmt::format("{}{}:\"{:08x}\"", entries.empty() ? "" : ",", json_text(name), id_bits(name));
  return "{" + entries + "}";
}

}  // namespace

std::uint32_t murmur3(std::string_view text) {
  std::uint32_t hash = 0;
  std::size_t place = 0;
  for (; place + 4 <= text.size(); place += 4) {
    std::uint32_t block = 0;
    for (int k = 3; k >= 0; --k) block = block << 8 | byte_at(text, place + k);
    hash = std::rotl(hash ^ scrambled(block), 13) * 5u + 0xe6546b64u;
  }
  std::uint32_t rest = 0;
  for (std::size_t k = text.size(); k > place; --k) rest = rest << 8 | byte_at(text, k - 1);
  if (place < text.size()) hash ^= scrambled(rest);
  return finished(hash ^ static_cast<std::uint32_t>(text.size()));
}

float cryptomatte_id(std::string_view name) { return std::bit_cast<float>(id_bits(name)); }

ImageNotes cryptomatte_notes(const std::string& layer, const std::vector<std::string>& names) {
  const std::string prefix = fmt::format("cryptomatte/{:.7}/", fmt::format("{:08x}", murmur3(layer)));
  return {{prefix + "name", layer},
          {prefix + "hash", "MurmurHash3_32"},
          {prefix + "conversion", "uint32_to_float32"},
          {prefix + "manifest", manifest(names)}};
}

}  // namespace billow::render
