// Text files that users write: read whole, and only if they are text.
#include "cli/text/text_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "base/regular_file.h"
#include "base/utf8.h"

namespace billow::cli {
namespace {

constexpr std::size_t longest = 40;  // [characters] that a message quotes

bool is_control(unsigned char byte) {
  return (byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') || byte == 0x7F;
}

// Bytes of the text character at the front of `bytes`, 0 if there is none.
int character_length(std::string_view bytes) {
  return is_control(static_cast<unsigned char>(bytes[0])) ? 0 : utf8_length(bytes);
}

}  // namespace

std::string read_text_file(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  return read_regular_file(file, max_bytes, "; this is no scene");
}

std::string read_standard_input(std::uintmax_t max_bytes) {
  std::string bytes;
  std::array<char, 1 << 16> block;
  while (bytes.size() <= max_bytes) {
    const ssize_t got = read(STDIN_FILENO, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw InputError(fmt::format("<stdin>: cannot be read: {}", std::strerror(errno)));
    if (got == 0) return bytes;
    bytes.append(block.data(), static_cast<std::size_t>(got));
  }
  throw InputError(fmt::format("<stdin>: larger than {} KiB; this is no scene", max_bytes / 1024));
}

std::optional<std::size_t> find_non_text(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const int length = character_length(bytes.substr(i));
    if (length == 0) return i;
    i += static_cast<std::size_t>(length);
  }
  return std::nullopt;
}

void check_utf8_text(std::string_view bytes, const std::string& name) {
  const std::optional<std::size_t> bad = find_non_text(bytes);
  if (!bad) return;
  const std::string_view before = bytes.substr(0, *bad);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t begin = before.rfind('\n') + 1;  // npos + 1 is 0
  throw InputError(fmt::format("{}:{}:{}: byte 0x{:02x} does not belong in UTF-8 text", name, line,
                               character_count(before.substr(begin)) + 1, static_cast<unsigned char>(bytes[*bad])));
}

std::size_t character_count(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return !is_continuation(c); }));
}

bool is_file_name(std::string_view text) {
  return !text.empty() && text.size() <= 64 &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == text.npos;
}

std::string lower_case(std::string name) {
  for (char& c : name)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return name;
}

std::string shortened(std::string_view text) {
  if (character_count(text) <= longest) return std::string(text);
  std::size_t end = 0;
  for (std::size_t characters = 0; characters < longest - 3; ++characters) do
      ++end;
    while (is_continuation(text[end]));
  return std::string(text.substr(0, end)) + "...";
}

std::string shortened_around(std::string_view text, std::size_t place) {
  std::size_t begin = std::min(place, text.size()), end = begin;
  for (std::size_t k = 0; k < longest / 2; ++k) {
    if (begin > 0) do
        --begin;
      while (begin > 0 && is_continuation(text[begin]));
    if (end < text.size()) do
        ++end;
      while (end < text.size() && is_continuation(text[end]));
  }
  return fmt::format("{}{}{}", begin > 0 ? "…" : "", text.substr(begin, end - begin), end < text.size() ? "…" : "");
}

}  // namespace billow::cli
