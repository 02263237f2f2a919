// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace billow {

/// A temporary file beside `target` that takes its name on commit() and is removed without one. Only the temporary
/// file is ever removed; a failure leaves what `target` was before. Every failure is an OutputError with the system's
/// reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends `size` bytes; false, with errno set, when they cannot all be written.
  bool write(const void* bytes, std::size_t size) noexcept;
  /// Appends them, or throws.
  void append(std::string_view bytes);
  /// Where the bytes are until commit(), for a program that writes them itself, instead of write().
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Flushes, closes and renames; write_durably() says how far it flushes.
  void commit();
  /// Throws OutputError for `target` with the reason that errno holds.
  [[noreturn]] void fail() const;

 private:
  std::filesystem::path target_, temporary_;
  std::FILE* stream_ = nullptr;
};

/// From now on commit() waits until the bytes are on the disk before they have their name, so that even after a power
/// cut no name stands for less than the whole file. For the whole process, like umask: call it before the first file.
void write_durably();

/// Where files are written durably, waits until the names in `folder` and in those below are on the disk too. Throws
/// OutputError.
void settle_names(const std::filesystem::path& folder);

/// Writes any bytes whole or not at all. Throws OutputError.
void write_file_atomically(const std::filesystem::path& file, const std::string& contents);

}  // namespace billow
