// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/sudden_end.h"

namespace billow {

/// A temporary file beside `target` that takes its name on commit() and is removed without one, also when the process
/// ends suddenly; what a killed process leaves, remove_strays() removes. Only the temporary file is ever removed; a
/// failure leaves what `target` was before. Every failure is an OutputError with the system's reason.
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
  void open_temporary();

  std::filesystem::path target_, temporary_;
  std::optional<UnfinishedFile> unfinished_;
  std::FILE* stream_ = nullptr;
};

/// A hidden name beside `target` for a file on its way to that name: unique in this process and, by the process's
/// number, on this machine. remove_strays() knows it.
std::filesystem::path temporary_name(const std::filesystem::path& target);

/// Removes from `folder` the temporary files of processes that are gone: of this machine's by their numbers, of other
/// machines' those that nothing has been written to for a day. Those of running processes stay, and so does anything
/// else; a folder that is not there has none. What cannot be removed stays.
void remove_strays(const std::filesystem::path& folder);

/// Whether `name` is that of a temporary file.
bool is_temporary_name(std::string_view name);

/// From now on commit() waits until the bytes are on the disk before they have their name, so that even after a power
/// cut no name stands for less than the whole file. For the whole process, like umask: call it before the first file.
void write_durably();

/// Where files are written durably, waits until the names in `folder` and in those below are on the disk too. Throws
/// OutputError.
void settle_names(const std::filesystem::path& folder);

/// Writes any bytes whole or not at all. Throws OutputError.
void write_file_atomically(const std::filesystem::path& file, const std::string& contents);

}  // namespace billow
