// Text in XML, and so in SVG and HTML.
#pragma once

#include <string>
#include <string_view>

namespace billow {

/// `text` with U+FFFD for whatever XML or HTML must not hold in any form, nor pictures can show: bytes that are no
/// UTF-8, control characters other than tab and line ends, and Unicode's noncharacters, such as U+FFFE. Its markup is
/// left as it is.
std::string xml_characters(std::string_view text);

/// `text` as XML, SVG and HTML show it, within an element or a quoted attribute: the characters that they may hold,
/// with & < > " ' escaped.
std::string xml_escape(std::string_view text);

}  // namespace billow
