// Large arrays on large pages: a pass over many megabytes otherwise spends its time looking addresses up.
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace billow {

/// A page of 2 MiB, and how large an array must be to be worth some.
constexpr std::size_t huge_page = std::size_t{1} << 21, least_huge = 2 * huge_page;

/// Asks the system to keep [memory, memory + bytes) on huge pages, also what has been written already. Only a hint:
/// nothing happens where the array is small or the system has none.
void use_huge_pages(const void* memory, std::size_t bytes);

/// The same for a matrix's memory.
inline void use_huge_pages(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  use_huge_pages(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(double));
}

}  // namespace billow
