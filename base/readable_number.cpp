// Rounding, grouping, exponents. Independent of the locale.
#include "base/readable_number.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace billow {

namespace {

constexpr double smallest_plain = 1e-4, first_power = 1e7;

std::string superscript(int number) {
  static constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(number))) text += digits[digit - '0'];
  return text;
}

// "14502.50" -> "14,502.50"
void group_thousands(std::string& digits) {
  const std::size_t point = std::min(digits.find('.'), digits.size());
  for (std::size_t at = point; at > 3; at -= 3) digits.insert(at - 3, 1, ',');
}

void drop_trailing_zeros(std::string& digits) {
  if (digits.find('.') == std::string::npos) return;
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
}

std::string scientific(double size, int digits) {
  const std::string text = fmt::format("{:.{}e}", size, digits - 1);
  const std::size_t e = text.find('e');
  std::string mantissa = text.substr(0, e);
  drop_trailing_zeros(mantissa);
  const std::string power = power_of_ten(std::atoi(text.c_str() + e + 1));
  return mantissa == "1" ? power : mantissa + " × " + power;
}

}  // namespace

std::string power_of_ten(int exponent) { return "10" + superscript(exponent); }

std::string readable_fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool negative = value < 0.0 && text.find_first_of("123456789") != std::string::npos;
  group_thousands(text);
  return negative ? "\u2212" + text : text;
}

std::string grouped(long number) { return readable_fixed(static_cast<double>(number), 0); }

std::string counted(long number, std::string_view one, std::string_view many) {
  if (number == 1) return fmt::format("1 {}", one);
  return many.empty() ? fmt::format("{} {}s", grouped(number), one) : fmt::format("{} {}", grouped(number), many);
}

std::string readable(double value, int digits) {
  if (!std::isfinite(value)) return fmt::format("{}", value);
  const double size = std::abs(value);
  if (size == 0.0) return "0";
  if (size < smallest_plain || size >= first_power) return (value < 0.0 ? "\u2212" : "") + scientific(size, digits);
  const int exponent = std::atoi(fmt::format("{:.{}e}", size, digits - 1).substr(digits > 1 ? digits + 2 : 2).c_str());
  std::string text = fmt::format("{:.{}f}", size, std::max(0, digits - 1 - exponent));
  drop_trailing_zeros(text);
  group_thousands(text);
  return value < 0.0 ? "\u2212" + text : text;
}

}  // namespace billow
