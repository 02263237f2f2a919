// UTF-8, character by character.
#pragma once

#include <string_view>

namespace billow {

/// Bytes of the well-formed UTF-8 character at the front of `bytes`, 0 if there is none: neither overlong forms nor
/// surrogates nor what lies past U+10FFFF are characters.
int utf8_length(std::string_view bytes);

}  // namespace billow
