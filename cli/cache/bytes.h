// Numbers as bytes in the order that a file format wants, whatever the machine's own.
#pragma once

#include <Eigen/Core>
#include <bit>
#include <concepts>
#include <cstdint>
#include <string>

namespace billow::cli {

enum class ByteOrder { little, big };

/// Appends `value`, lowest byte first or last.
template <ByteOrder order, std::unsigned_integral T>
void put(std::string& bytes, T value) {
  for (std::size_t k = 0; k < sizeof(T); ++k) {
    const std::size_t place = order == ByteOrder::little ? k : sizeof(T) - 1 - k;
    bytes.push_back(static_cast<char>(value >> (8 * place) & 0xffu));
  }
}

template <ByteOrder order>
void put(std::string& bytes, std::int32_t value) {
  put<order>(bytes, static_cast<std::uint32_t>(value));
}

template <ByteOrder order>
void put(std::string& bytes, float value) {
  put<order>(bytes, std::bit_cast<std::uint32_t>(value));
}

/// Appends all of `values`, row by row.
template <ByteOrder order, class Rows>
void put_rows(std::string& bytes, const Eigen::MatrixBase<Rows>& values) {
  for (Eigen::Index r = 0; r < values.rows(); ++r)
    for (Eigen::Index c = 0; c < values.cols(); ++c) put<order>(bytes, values(r, c));
}

}  // namespace billow::cli
