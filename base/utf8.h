// Characters of UTF-8 text.
#pragma once

#include <string_view>

namespace billow {

/// The character that some bytes begin with.
struct Character {
  char32_t code = 0;
  int bytes = 0;  // that it takes; 0 where the bytes are empty or begin with no well-formed UTF-8
};

/// Overlong forms, surrogates and everything past U+10FFFF are not well-formed.
Character first_character(std::string_view bytes);

/// Bytes of the well-formed character at the front of `bytes`, 0 if there is none.
inline int utf8_length(std::string_view bytes) { return first_character(bytes).bytes; }

/// Whether the byte goes on with a character that an earlier one began.
inline bool is_continuation(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

}  // namespace billow
