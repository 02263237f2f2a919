// Quotes, and formulas made harmless.
#include "base/csv.h"

#include <algorithm>
#include <cstddef>

namespace billow {
namespace {

constexpr std::string_view digits = "0123456789";

// Takes the digits at the front of `text`; their number.
std::size_t take_digits(std::string_view& text) {
  const std::size_t count = std::min(text.find_first_not_of(digits), text.size());
  text.remove_prefix(count);
  return count;
}

void take_sign(std::string_view& text) {
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
}

// "-1", "+.5", "-2.5e-3".
bool is_number(std::string_view text) {
  take_sign(text);
  std::size_t count = take_digits(text);
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    count += take_digits(text);
  }
  if (count == 0) return false;
  if (text.starts_with('e') || text.starts_with('E')) {
    text.remove_prefix(1);
    take_sign(text);
    if (take_digits(text) == 0) return false;
  }
  return text.empty();
}

// Also the full-width forms of = + - @, which some spreadsheets read as these.
bool begins_a_formula(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  for (const std::string_view sign : {"=", "+", "-", "@", "\uFF1D", "\uFF0B", "\uFF0D", "\uFF20"})
    if (text.starts_with(sign)) return !is_number(text);
  return false;
}

}  // namespace

std::string csv_field(std::string_view text) {
  std::string field = begins_a_formula(text) ? "'" : "";
  field += text;
  if (field.find_first_of(",;\"\t\n\r") == std::string::npos) return field;
  std::string out = "\"";
  for (const char c : field) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

}  // namespace billow
