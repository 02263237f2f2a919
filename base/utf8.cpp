// The table of well-formed byte sequences: https://www.unicode.org/versions/latest/ch03.pdf, table 3-7.
#include "base/utf8.h"

#include <cstddef>

namespace billow {
namespace {

bool is_continuation(unsigned char byte) { return (byte & 0xC0) == 0x80; }

// Bytes of the sequence that begins with `lead`, 0 if none does.
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

int utf8_length(std::string_view bytes) {
  if (bytes.empty()) return 0;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const int length = sequence_length(byte(0));
  if (static_cast<std::size_t>(length) > bytes.size()) return 0;
  for (int i = 1; i < length; ++i)
    if (!is_continuation(byte(i))) return 0;
  return length > 1 && !second_byte_fits(byte(0), byte(1)) ? 0 : length;
}

}  // namespace billow
