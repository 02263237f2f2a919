// Three bytes are four letters.
#include "cli/cache/base64.h"

#include <cstdint>

namespace billow::cli {

std::string base64(std::string_view bytes) {
  static constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t b = 0; b < bytes.size(); b += 3) {
    const std::string_view some = bytes.substr(b, 3);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < some.size() ? std::uint8_t(some[k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= some.size() ? letters[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace billow::cli
