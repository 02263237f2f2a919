// Encodings, line ends, words and numbers of mesh files.
#include "sim/import/mesh_text.h"

#include <charconv>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"

namespace billow::sim {
namespace {

void append_utf8(std::string& text, std::uint32_t c) {
  const auto tail = [&](int shift) { text += static_cast<char>(0x80 | ((c >> shift) & 0x3f)); };
  if (c < 0x80) {
    text += static_cast<char>(c);
  } else if (c < 0x800) {
    text += static_cast<char>(0xc0 | (c >> 6));
    tail(0);
  } else if (c < 0x10000) {
    text += static_cast<char>(0xe0 | (c >> 12));
    tail(6), tail(0);
  } else {
    text += static_cast<char>(0xf0 | (c >> 18));
    tail(12), tail(6), tail(0);
  }
}

// Whether UTF-16 code units have their low byte first; -1: it is no UTF-16.
int utf16_order(std::string_view bytes) {
  if (bytes.starts_with("\xff\xfe")) return 1;
  if (bytes.starts_with("\xfe\xff")) return 0;
  if (bytes.size() < 4) return -1;
  const auto letter = [&](std::size_t k) { return bytes[k] != '\0' && static_cast<unsigned char>(bytes[k]) < 0x80; };
  if (letter(0) && bytes[1] == '\0' && letter(2) && bytes[3] == '\0') return 1;
  if (bytes[0] == '\0' && letter(1) && bytes[2] == '\0' && letter(3)) return 0;
  return -1;
}

std::string from_utf16(std::string_view bytes, bool low_first) {
  constexpr std::uint32_t replacement = 0xfffd;
  const auto unit = [&](std::size_t k) -> std::uint32_t {
    const auto first = static_cast<unsigned char>(bytes[k]), second = static_cast<unsigned char>(bytes[k + 1]);
    return low_first ? first | second << 8 : second | first << 8;
  };
  std::string text;
  for (std::size_t k = 0; k + 1 < bytes.size(); k += 2) {
    std::uint32_t c = unit(k);
    if (c == 0xfeff && k == 0) continue;
    if (c >= 0xd800 && c < 0xe000) {
      const bool pair = c < 0xdc00 && k + 3 < bytes.size() && unit(k + 2) >= 0xdc00 && unit(k + 2) < 0xe000;
      c = pair ? 0x10000 + ((c - 0xd800) << 10) + (unit(k + 2) - 0xdc00) : replacement;
      if (pair) k += 2;
    }
    append_utf8(text, c);
  }
  return text;
}

void unify_line_ends(std::string& text) {
  std::size_t to = 0;
  for (std::size_t from = 0; from < text.size(); ++from) {
    if (text[from] == '\r' && from + 1 < text.size() && text[from + 1] == '\n') continue;
    text[to++] = text[from] == '\r' ? '\n' : text[from];
  }
  text.resize(to);
}

std::string shortened(std::string_view word) {
  constexpr std::size_t longest = 40;
  return word.size() <= longest ? std::string(word) : std::string(word.substr(0, longest)) + "…";
}

}  // namespace

std::string plain_text(std::string bytes) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.erase(0, 3);
  if (const int order = utf16_order(bytes); order >= 0) bytes = from_utf16(bytes, order == 1);
  unify_line_ends(bytes);
  return bytes;
}

double number_in(std::string_view word) {
  const std::string_view digits = word.substr(word.starts_with('+') && !word.starts_with("+-") ? 1 : 0);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || end != digits.data() + digits.size() || error == std::errc::invalid_argument)
    throw InputError(fmt::format("'{}' is not a number{}", shortened(word),
                                 word.find(',') != word.npos ? "; write decimals with a point" : ""));
  if (error == std::errc::result_out_of_range) {
    // Too large, or too close to 0, which is 0 then.
    const std::size_t exponent = digits.find_first_of("eE");
    const bool tiny = exponent != digits.npos && digits.substr(exponent + 1).starts_with('-');
    return tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  return value;
}

long long integer_in(std::string_view word) {
  const std::string_view digits = word.substr(word.starts_with('+') && !word.starts_with("+-") ? 1 : 0);
  long long value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || end != digits.data() + digits.size() || error != std::errc())
    throw InputError(fmt::format("'{}' is not a whole number", shortened(word)));
  return value;
}

void TextWords::skip(bool across_lines) {
  for (; at_ < text_.size(); ++at_) {
    const char c = text_[at_];
    if (c == '\n') {
      if (!across_lines) return;
      ++line_;
    } else if (c == comment_) {
      at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
    } else if (!is_blank(c)) {
      return;
    }
  }
}

std::string_view TextWords::next() {
  skip(true);
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != comment_) ++at_;
  return text_.substr(begin, at_ - begin);
}

bool TextWords::more() {
  skip(true);
  return at_ < text_.size();
}

bool TextWords::more_on_line() {
  skip(false);
  return at_ < text_.size() && text_[at_] != '\n';
}

std::string_view TextWords::need(std::string_view what) {
  const int last_line = line_;
  const std::string_view word = next();
  if (word.empty())
    throw InputError(
        fmt::format("it ends in line {}, where {} should be; it is truncated, export it again", last_line, what));
  return word;
}

double TextWords::number(std::string_view what) {
  const std::string_view word = need(what);
  try {
    return number_in(word);
  } catch (const InputError& error) {
    throw InputError(fmt::format("line {}: {} should be here, but {}", line_, what, error.what()));
  }
}

long long TextWords::integer(std::string_view what) {
  const std::string_view word = need(what);
  try {
    return integer_in(word);
  } catch (const InputError& error) {
    throw InputError(fmt::format("line {}: {} should be here, but {}", line_, what, error.what()));
  }
}

}  // namespace billow::sim
