// Numbers as PNG keeps them: the highest byte first.
#pragma once

#include <cstdint>

namespace billow::render {

inline std::uint32_t big_endian(const unsigned char* bytes) {
  return std::uint32_t(bytes[0]) << 24 | std::uint32_t(bytes[1]) << 16 | std::uint32_t(bytes[2]) << 8 | bytes[3];
}

}  // namespace billow::render
