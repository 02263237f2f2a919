// Text in tables of comma-separated values.
#pragma once

#include <string>
#include <string_view>

namespace billow {

/// `text` as a field of a CSV file: between quotes where commas, quotes or line breaks ask for it (RFC 4180), and
/// behind an apostrophe where a spreadsheet would take it for a formula: where its first character that is no blank is
/// one of = + - @, unless it is a number.
std::string csv_field(std::string_view text);

}  // namespace billow
