// Arrays that start on a cache line, so that no vector of the passes straddles two.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

#include "base/huge_pages.h"

namespace billow {

/// Allocates at multiples of 64 bytes: a cache line, and the widest vector of any processor that we know. Large arrays
/// are on huge pages from the first.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};

  CacheLineAllocator() = default;
  template <class Other>
  CacheLineAllocator(const CacheLineAllocator<Other>&) {}
  T* allocate(std::size_t count) {
    void* const memory = ::operator new(count * sizeof(T), alignment);
    use_huge_pages(memory, count * sizeof(T));
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, alignment); }
  bool operator==(const CacheLineAllocator&) const { return true; }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace billow
