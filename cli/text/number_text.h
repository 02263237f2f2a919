// Numbers as scenes write them. Independent of the locale, and stricter than YAML.
#pragma once

#include <string>
#include <string_view>

namespace billow::cli {

enum class NumberFault { none, not_a_number, decimal_comma, leading_zero, not_finite, out_of_range };

struct ParsedNumber {
  double value = 0.0;
  NumberFault fault = NumberFault::none;
};

/// Reads a decimal number that fills the whole text: "-0.5", "+3", ".25", "1e6". No hexadecimal or octal numbers, no
/// digits grouped by commas or underscores, nothing infinite.
ParsedNumber parse_number(std::string_view text);

/// True for an optional sign followed by decimal digits only.
bool is_whole_number(std::string_view text);

/// Decimal text of the fewest digits that parse_number reads back to exactly `value`.
std::string shortest(double value);

}  // namespace billow::cli
