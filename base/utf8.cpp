// The table of well-formed byte sequences: https://www.unicode.org/versions/latest/ch03.pdf, table 3-7.
#include "base/utf8.h"

namespace billow {
namespace {

// Bytes of the UTF-8 sequence that begins with `lead`, 0 if none does.
int sequence_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  if (lead >= 0xF0 && lead < 0xF5) return 4;
  return 0;
}

// The second byte rules out overlong forms, surrogates and everything past U+10FFFF.
bool second_byte_fits(unsigned char lead, unsigned char second) {
  if (lead == 0xE0) return second >= 0xA0;
  if (lead == 0xED) return second < 0xA0;
  if (lead == 0xF0) return second >= 0x90;
  if (lead == 0xF4) return second < 0x90;
  return true;
}

}  // namespace

Character first_character(std::string_view bytes) {
  if (bytes.empty()) return {};
  const auto byte = [&](int k) { return static_cast<unsigned char>(bytes[static_cast<std::size_t>(k)]); };
  const int length = sequence_length(byte(0));
  if (length == 0 || static_cast<std::size_t>(length) > bytes.size()) return {};
  if (length == 1) return {byte(0), 1};
  if (!second_byte_fits(byte(0), byte(1))) return {};
  char32_t code = byte(0) & (0x7F >> length);
  for (int k = 1; k < length; ++k) {
    if (!is_continuation(bytes[static_cast<std::size_t>(k)])) return {};
    code = code << 6 | (byte(k) & 0x3F);
  }
  return {code, length};
}

}  // namespace billow
