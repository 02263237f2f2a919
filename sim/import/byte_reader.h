// Numbers in binary mesh files.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>

#include "base/error.h"

namespace billow::sim {

/// Takes numbers off the front of some bytes, never past their end.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::endian order) : rest_(bytes), swaps_(order != std::endian::native) {}

  template <typename T>
  T take() {
    char raw[sizeof(T)];
    if (rest_.size() < sizeof(T)) throw InputError("its data end too early; it is truncated");
    std::memcpy(raw, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    if (swaps_) std::reverse(raw, raw + sizeof(T));
    T value;
    std::memcpy(&value, raw, sizeof(T));
    return value;
  }

  std::size_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
  bool swaps_;
};

}  // namespace billow::sim
