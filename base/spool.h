// A file without a name for what would not fit in memory.
#pragma once

#include <cstddef>
#include <filesystem>

#include "base/atomic_file.h"

namespace billow {

/// Bytes that are appended now and read again later, in a temporary file without a name: it vanishes with the process,
/// however that ends. Every failure is an OutputError that names `purpose`, the file that the bytes are for.
class Spool {
 public:
  /// Lies in the folder of `purpose`, where the space for the result must be anyway.
  explicit Spool(const std::filesystem::path& purpose);
  ~Spool();
  Spool(Spool&& other) noexcept;
  Spool& operator=(Spool&& other) noexcept;

  void append(const void* bytes, std::size_t size);
  /// Exactly `size` bytes from `offset` on; they must have been appended.
  void read(void* bytes, std::size_t size, std::size_t offset) const;
  /// The first `size` bytes, onto the end of `file`.
  void copy_to(AtomicFile& file, std::size_t size) const;

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path purpose_;
  int descriptor_ = -1;
};

}  // namespace billow
