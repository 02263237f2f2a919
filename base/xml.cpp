// https://www.w3.org/TR/xml/#charsets and #syntax
#include "base/xml.h"

#include <cstddef>

#include "base/utf8.h"

namespace billow {
namespace {

bool is_xml_character(std::string_view character) {
  const auto byte = static_cast<unsigned char>(character[0]);
  if (byte < 0x20) return byte == '\t' || byte == '\n' || byte == '\r';
  return character != "\uFFFE" && character != "\uFFFF";
}

}  // namespace

std::string xml_characters(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const int length = utf8_length(text);
    const std::string_view character = text.substr(0, length > 0 ? static_cast<std::size_t>(length) : 1);
    if (length > 0 && is_xml_character(character))
      out += character;
    else
      out += "\uFFFD";
    text.remove_prefix(character.size());
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
