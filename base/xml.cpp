// https://www.w3.org/TR/xml/#charsets and
// https://html.spec.whatwg.org/multipage/parsing.html#preprocessing-the-input-stream
#include "base/xml.h"

#include <algorithm>

#include "base/utf8.h"

namespace billow {
namespace {

bool is_control(char32_t code) {
  return (code < 0x20 && code != '\t' && code != '\n' && code != '\r') || (code >= 0x7F && code < 0xA0);
}

bool is_noncharacter(char32_t code) { return (code & 0xFFFE) == 0xFFFE || (code >= 0xFDD0 && code <= 0xFDEF); }

}  // namespace

std::string xml_characters(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const Character character = first_character(text);
    const bool fits = character.bytes > 0 && !is_control(character.code) && !is_noncharacter(character.code);
    const auto size = static_cast<std::size_t>(std::max(character.bytes, 1));
    out += fits ? text.substr(0, size) : "\uFFFD";
    text.remove_prefix(size);
  }
  return out;
}

std::string xml_escape(std::string_view text) {
  std::string escaped;
  for (const char c : xml_characters(text)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace billow
