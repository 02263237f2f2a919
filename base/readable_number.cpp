// Numbers as people read them.
#include "base/readable_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace billow {

std::string superscript(int number) {
  static constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(number))) text += digits[digit - '0'];
  return text;
}

std::string readable_number(double value, int digits) {
  const std::string sign = std::signbit(value) && value != 0.0 ? "\u2212" : "";
  if (value == 0.0 || !std::isfinite(value)) return sign + fmt::format("{:g}", std::abs(value));
  const std::string text = fmt::format("{:.{}e}", std::abs(value), digits - 1);  // rounds before the size is judged
  const std::size_t e = text.find('e');
  const int exponent = std::stoi(text.substr(e + 1));
  if (exponent >= -3 && exponent < 5)
    return sign + fmt::format("{:.{}g}", std::abs(value), std::max(digits, exponent + 1));
  const std::string mantissa = fmt::format("{:g}", std::stod(text.substr(0, e)));
  return sign + (mantissa == "1" ? "" : mantissa + "·") + "10" + superscript(exponent);
}

std::string grouped(long number) {
  std::string text = std::to_string(std::abs(number));
  for (std::size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, ",");
  return (number < 0 ? "\u2212" : "") + text;
}

}  // namespace billow
