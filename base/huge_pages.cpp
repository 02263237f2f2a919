// Advice to Linux's memory management.
#include "base/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace billow {

namespace {

#ifdef MADV_COLLAPSE
constexpr int collapse = MADV_COLLAPSE;
#else
constexpr int collapse = 25;  // Linux 6.1; an older one refuses it and gathers the pages in its own time
#endif

}  // namespace

void use_huge_pages(const void* memory, std::size_t bytes) {
  if (bytes < least_huge) return;
  const std::uintptr_t begin = (reinterpret_cast<std::uintptr_t>(memory) + huge_page - 1) / huge_page * huge_page;
  const std::uintptr_t end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / huge_page * huge_page;
  void* const whole = reinterpret_cast<void*>(begin);
  madvise(whole, end - begin, MADV_HUGEPAGE);
  madvise(whole, end - begin, collapse);
}

}  // namespace billow
