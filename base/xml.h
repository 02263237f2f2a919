// Text in XML, and so in SVG and HTML.
#pragma once

#include <string>
#include <string_view>

namespace billow {

/// `text` with U+FFFD for whatever an XML 1.0 document must not hold in any form: bytes that are no UTF-8, control
/// characters other than tab and line ends, U+FFFE and U+FFFF. Its markup is left as it is.
std::string xml_characters(std::string_view text);

/// `text` as XML, SVG and HTML show it, within an element or a quoted attribute: only characters that XML may hold, and
/// & < > " ' escaped.
std::string xml_escape(std::string_view text);

}  // namespace billow
