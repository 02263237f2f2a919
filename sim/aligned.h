// Arrays that start on a cache line, so that no vector of the passes straddles two.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace billow::sim {

/// Allocates at multiples of 64 bytes: a cache line, and the widest vector of any processor that we know.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};

  CacheLineAllocator() = default;
  template <class Other>
  CacheLineAllocator(const CacheLineAllocator<Other>&) {}
  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), alignment)); }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, alignment); }
  bool operator==(const CacheLineAllocator&) const { return true; }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace billow::sim
