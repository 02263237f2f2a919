// Numbers as scenes write them. Independent of the locale, and stricter than YAML.
#include "cli/text/number_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace billow::cli {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view without_sign(std::string_view text) {
  return !text.empty() && (text[0] == '+' || text[0] == '-') ? text.substr(1) : text;
}

// Every spelling of the non-finite numbers in YAML, C and the usual programs.
bool names_a_non_finite(std::string_view text) {
  text = without_sign(text);
  if (text.starts_with('.')) text.remove_prefix(1);
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

NumberFault fault_of_bad_text(std::string_view text) {
  if (names_a_non_finite(text)) return NumberFault::not_finite;
  std::string with_point(text);
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  const bool comma = with_point != text && parse_number(with_point).fault == NumberFault::none;
  return comma ? NumberFault::decimal_comma : NumberFault::not_a_number;
}

}  // namespace

bool is_whole_number(std::string_view text) {
  text = without_sign(text);
  return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

ParsedNumber parse_number(std::string_view text) {
  const std::string_view digits = without_sign(text);
  // YAML 1.1 reads 010 as 8, YAML 1.2 as 10: nobody should have to know.
  if (digits.size() > 1 && digits[0] == '0' && is_digit(digits[1])) return {0.0, NumberFault::leading_zero};
  const bool begins_well = !digits.empty() && (is_digit(digits[0]) || digits[0] == '.');
  double value = 0.0;
  const char* end = digits.data() + digits.size();
  const auto result = std::from_chars(digits.data(), end, value);
  if (!begins_well || result.ec == std::errc::invalid_argument || result.ptr != end)
    return {0.0, fault_of_bad_text(text)};
  if (result.ec == std::errc::result_out_of_range) return {0.0, NumberFault::out_of_range};
  return {text[0] == '-' ? -value : value, NumberFault::none};
}

std::string shortest(double value) {
  std::array<char, 32> buffer;
  const double size = std::abs(value);
  const bool fixed = size == 0.0 || (size >= 1e-5 && size < 1e15);
  const auto format = fixed ? std::chars_format::fixed : std::chars_format::scientific;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format);
  std::string text(buffer.data(), result.ptr);
  // YAML 1.1, and so Python's reader, takes 1e-06 for a word.
  if (!fixed && text.find('.') == std::string::npos) text.insert(text.find('e'), ".0");
  return text;
}

}  // namespace billow::cli
